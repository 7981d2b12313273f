#include "c_api/objects.h"
#include "c_api/setting_names.h"

using rpf::c_api::guarded;
using rpf::c_api::require;

rpf_status rpf_settings_new(const char* preset, rpf_settings** settings) {
  return guarded([&] {
    require(settings, "rpf_settings_new: settings");
    *settings = nullptr;
    *settings = new rpf_settings{rpf::c_api::settings_named(preset == nullptr ? "balanced" : preset)};
  });
}

rpf_status rpf_settings_set(rpf_settings* settings, const char* name, const char* value) {
  return guarded([&] {
    require(settings, "rpf_settings_set: settings");
    require(name, "rpf_settings_set: name");
    require(value, "rpf_settings_set: value");
    rpf::c_api::set(settings->value, name, value);
  });
}

void rpf_settings_free(rpf_settings* settings) { delete settings; }

rpf_status rpf_device_list_new(rpf_device_list** devices) {
  return guarded([&] {
    require(devices, "rpf_device_list_new: devices");
    *devices = nullptr;
    *devices = new rpf_device_list{rpf::devices()};
  });
}

int rpf_device_list_size(const rpf_device_list* devices) { return static_cast<int>(devices->value.size()); }

const char* rpf_device_list_name(const rpf_device_list* devices, int number) {
  const bool is_there = number >= 0 && number < rpf_device_list_size(devices);
  return is_there ? devices->value[static_cast<std::size_t>(number)].name.c_str() : "";
}

void rpf_device_list_free(rpf_device_list* devices) { delete devices; }
