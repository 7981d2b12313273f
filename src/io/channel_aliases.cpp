#include "io/channel_names.h"

#include <iterator>

namespace rpf::io {
namespace {

// A name that is missing here is a row, not code. Depth has no row: with a world position it says nothing new, and "Z"
// in a deep file means compositing depth.
const ChannelAlias table[] = {
    // pbrt-v4, GBufferFilm (src/pbrt/film.cpp); the names without a dot are those of its first releases.
    // It writes the geometric normal N and the shading normal Ns side by side, so Ns is a group of its own.
    {"P.*", "XYZ", "feature.P.*", "XYZ", false},
    {"P*", "xyz", "feature.P.*", "XYZ", false},
    {"N.*", "XYZ", "feature.N.*", "XYZ", false},
    {"N*", "xyz", "feature.N.*", "XYZ", false},
    {"Ns.*", "XYZ", "feature.Ns.*", "XYZ", false},
    {"Ns*", "xyz", "feature.Ns.*", "XYZ", false},
    {"Albedo.*", "RGB", "feature.albedo.*", "RGB", false},
    {"*", "uv", "feature.uv.*", "UV", false},
    {"dzd*", "xy", "feature.dz.*", "XY", false},
    // Mitsuba 3, aov integrator (src/integrators/aov.cpp): the user chooses the part before the dot, these are the
    // names in its manual and those of the AOV types.
    {"nn.*", "XYZ", "feature.N.*", "XYZ", false},
    {"sh_normal.*", "XYZ", "feature.N.*", "XYZ", false},
    {"geo_normal.*", "XYZ", "feature.Ng.*", "XYZ", false},
    {"position.*", "XYZ", "feature.P.*", "XYZ", false},
    {"pos.*", "XYZ", "feature.P.*", "XYZ", false},
    {"albedo.*", "RGB", "feature.albedo.*", "RGB", false},
    {"uv.*", "UV", "feature.uv.*", "UV", false},
    {"uv.*", "XY", "feature.uv.*", "UV", false},
    // Arnold, built-in AOVs (`kick -laovs`); P.X, N.X and albedo.R are above. Vector AOVs may be stored as RGB.
    {"P.*", "RGB", "feature.P.*", "XYZ", false},
    {"N.*", "RGB", "feature.N.*", "XYZ", false},
    {"diffuse_albedo.*", "RGB", "feature.albedo.*", "RGB", false},
    {"denoise_albedo.*", "RGB", "feature.albedo.*", "RGB", false},
    // Blender Cycles, render passes in a multilayer file, with or without the view layer's name in front.
    {"Combined.*", "RGBA", "*", "RGBA", true},
    {"Position.*", "XYZ", "feature.P.*", "XYZ", true},
    {"Normal.*", "XYZ", "feature.N.*", "XYZ", true},
    {"Denoising Normal.*", "XYZ", "feature.N.*", "XYZ", true},
    {"Denoising Albedo.*", "RGB", "feature.albedo.*", "RGB", true},
    {"UV.*", "UV", "feature.uv.*", "UV", true},
    // fbksd, RandomParameter and Feature (include/fbksd/renderer/samples.h); _1 is the second hit. Its _NS names
    // (first hit that is not specular) and DIRECT_LIGHT (noisy) are left to --map.
    {"COLOR_*", "RGB", "*", "RGB", false},
    {"IMAGE_*", "XY", "film.*", "XY", false},
    {"LENS_*", "UV", "random.lens.*", "UV", false},
    {"TIME", "", "random.time", "", false},
    {"LIGHT_*", "XY", "random.light.*", "UV", false},
    {"WORLD_*", "XYZ", "feature.P.*", "XYZ", false},
    {"NORMAL_*", "XYZ", "feature.N.*", "XYZ", false},
    {"TEXTURE_COLOR_*", "RGB", "feature.albedo.*", "RGB", false},
    {"WORLD_*_1", "XYZ", "feature.P2.*", "XYZ", false},
    {"NORMAL_*_1", "XYZ", "feature.N2.*", "XYZ", false},
    {"TEXTURE_COLOR_*_1", "RGB", "feature.albedo2.*", "RGB", false},
};

}  // namespace

const std::vector<ChannelAlias>& channel_aliases() {
  static const std::vector<ChannelAlias> aliases(std::begin(table), std::end(table));
  return aliases;
}

}  // namespace rpf::io
