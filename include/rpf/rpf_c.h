/* The library for C (C99 and later) and for languages that call C. Every function that can fail returns an rpf_status;
 * rpf_error_text() then says in one sentence what was wrong, with file, channel, pixel or option, and what to do. No
 * C++ exception leaves these functions. Objects are opaque; who makes one frees it, and freeing NULL does nothing.
 * Different objects may be used from different threads at once. Texts are UTF-8. docs/library.md has an introduction.
 */
#ifndef RPF_RPF_C_H
#define RPF_RPF_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
#ifdef __GNUC__
#pragma GCC visibility push(default)
#endif

/** What became of a call: the exit codes of the command (docs/commands.md). */
typedef enum rpf_status {
  RPF_OK = 0,         /**< done */
  RPF_INTERNAL = 1,   /**< a defect of this library */
  RPF_USAGE = 2,      /**< an argument or a setting that cannot be */
  RPF_INPUT = 3,      /**< a file or sample buffer that cannot be used */
  RPF_OUTPUT = 4,     /**< a result that could not be written */
  RPF_DEVICE = 5,     /**< a backend or device that is missing or failed */
  RPF_MEMORY = 6,     /**< more memory needed than there is, or than the limit allows */
  RPF_CANCELLED = 130 /**< stopped by a callback */
} rpf_status;

/** What went wrong in this thread's latest call that did not return RPF_OK; "" before the first. Never NULL, valid
 * until the thread's next call. */
const char* rpf_error_text(void);

/** "major.minor.patch" of the library. */
const char* rpf_version_text(void);

/* ---- settings ---- */

/** What is to be done: preset, options, device, limits. */
typedef struct rpf_settings rpf_settings;

/** Makes settings.
 * @param preset "fast", "balanced" or "high"; "thesis" or "paper" for the published algorithm; NULL: "balanced"
 * @param settings where the new object goes; free it with rpf_settings_free()
 * @return RPF_OK, or RPF_USAGE for an unknown name */
rpf_status rpf_settings_new(const char* preset, rpf_settings** settings);

/** Changes one setting. Names and values are those of the command's options without their dashes (rpf --help):
 * "backend" "opencl", "device" "1", "threads" "8", "max-memory" "4000" (MB), "model" "file.rpfnet", "noise" "0.002",
 * "boxes" "21,11,5" (or "none"), "features" "N,albedo", "random" "lens,time", "crop" "256x128+100+60"; switches take
 * "1" or "0": "clamp-negative", "filter-features" (the filtered features too, as rpf_filter() hands them over),
 * "estimate-error" (their channel "error").
 * @return RPF_OK, or RPF_USAGE for a name or a value that cannot be; nothing has changed then */
rpf_status rpf_settings_set(rpf_settings* settings, const char* name, const char* value);

/** Frees settings; NULL is allowed. */
void rpf_settings_free(rpf_settings* settings);

/* ---- devices ---- */

/** OpenCL devices as they were when asked for. */
typedef struct rpf_device_list rpf_device_list;

/** Asks for all OpenCL devices; takes some tenths of a second.
 * @param devices where the new list goes; free it with rpf_device_list_free()
 * @return RPF_OK, also where there is none; RPF_MEMORY */
rpf_status rpf_device_list_new(rpf_device_list** devices);

/** How many devices the list has; their numbers, which the setting "device" takes, are 0 to this less one. */
int rpf_device_list_size(const rpf_device_list* devices);

/** The name of a device; "" for a number that is not in the list. Valid as long as the list. */
const char* rpf_device_list_name(const rpf_device_list* devices, int number);

/** Frees a list; NULL is allowed. */
void rpf_device_list_free(rpf_device_list* devices);

/* ---- samples ---- */

/** All samples of a frame, each a record of floats (docs/file-format.md has the names of slots). */
typedef struct rpf_sample_buffer rpf_sample_buffer;

/** Makes a buffer for a renderer to write its samples into: the filter works in that memory, nothing is copied.
 * @param x,y position of the data window's first pixel
 * @param width,height pixels of the data window, 1 or more each
 * @param slots names of a record's values: "R", "G", "B", "film.X", "film.Y" at least, "random.lens.U", "feature.N.X",
 * ...
 * @param slot_count how many of them
 * @param samples_of_pixel [width * height], row by row: how many samples each pixel has, 0 is possible
 * @param buffer where the new object goes; free it with rpf_sample_buffer_free(). All its values are NaN, for missing
 * @return RPF_OK, RPF_INPUT for a slot that is there twice or missing, RPF_USAGE for a size that cannot be, RPF_MEMORY
 */
rpf_status rpf_sample_buffer_new(int x, int y, int width, int height, const char* const* slots, size_t slot_count,
                                 const uint32_t* samples_of_pixel, rpf_sample_buffer** buffer);

/** Reads a sample file, deep OpenEXR or raw floats.
 * @param path of the file
 * @param settings only the slots that these need are read, within their "max-memory"; NULL: all slots
 * @param buffer where the new object goes; free it with rpf_sample_buffer_free()
 * @return RPF_OK, RPF_INPUT, RPF_USAGE, RPF_MEMORY */
rpf_status rpf_sample_buffer_read(const char* path, const rpf_settings* settings, rpf_sample_buffer** buffer);

/** Writes a sample file: deep OpenEXR (".exr") or raw floats (".rpf"), whole or not at all.
 * @return RPF_OK, RPF_INPUT for an invalid buffer, RPF_OUTPUT */
rpf_status rpf_sample_buffer_write(const char* path, const rpf_sample_buffer* buffer);

/** The values, [sample][slot], samples in the order of their pixels; the caller may write them. Valid until the buffer
 * is freed or filtered. */
float* rpf_sample_buffer_values(rpf_sample_buffer* buffer);

/** How many samples the buffer has. */
size_t rpf_sample_buffer_sample_count(const rpf_sample_buffer* buffer);

/** How many values a sample has. */
size_t rpf_sample_buffer_slot_count(const rpf_sample_buffer* buffer);

/** Frees a buffer; NULL is allowed. */
void rpf_sample_buffer_free(rpf_sample_buffer* buffer);

/* ---- images ---- */

/** A linear image of floats. */
typedef struct rpf_image rpf_image;

/** Reads an image of any format that OpenImageIO knows.
 * @param image where the new object goes; free it with rpf_image_free()
 * @return RPF_OK, RPF_INPUT, RPF_MEMORY */
rpf_status rpf_image_read(const char* path, rpf_image** image);

/** Writes an image, whole or not at all; the extension chooses the format. Formats of 8 bits get the sRGB curve.
 * @return RPF_OK, RPF_OUTPUT */
rpf_status rpf_image_write(const char* path, const rpf_image* image);

/** Width in pixels. */
int rpf_image_width(const rpf_image* image);

/** Height in pixels. */
int rpf_image_height(const rpf_image* image);

/** How many channels a pixel has. */
int rpf_image_channel_count(const rpf_image* image);

/** The name of a channel, "R"; "" for a number that it does not have. Valid as long as the image. */
const char* rpf_image_channel_name(const rpf_image* image, int channel);

/** The values, [height][width][channel], linear. Valid as long as the image; nothing is copied. */
const float* rpf_image_pixels(const rpf_image* image);

/** Frees an image; NULL is allowed. */
void rpf_image_free(rpf_image* image);

/* ---- filtering ---- */

/** Called from the thread that called rpf_filter(), at least every half second or so of work.
 * @param fraction of the whole work that is done, 0 to 1
 * @param seconds_left an estimate; negative while there is none
 * @param user what rpf_filter() was given
 * @return 0 to stop: rpf_filter() then returns RPF_CANCELLED; anything else to go on */
typedef int rpf_progress_function(double fraction, double seconds_left, void* user);

/** Filters a frame. The result does not depend on threads, device or memory.
 * @param buffer taken over, whatever happens: *buffer is NULL afterwards
 * @param settings NULL: those of rpf_settings_new(NULL)
 * @param progress NULL: nobody watches
 * @param user handed to `progress`
 * @param image where the filtered image goes: R, G, B (A); free it with rpf_image_free()
 * @param features NULL, or where the filtered features go: with "filter-features" their image, else NULL
 * @return RPF_OK, RPF_USAGE, RPF_INPUT for an invalid buffer, RPF_DEVICE, RPF_MEMORY, RPF_CANCELLED */
rpf_status rpf_filter(rpf_sample_buffer** buffer, const rpf_settings* settings, rpf_progress_function* progress,
                      void* user, rpf_image** image, rpf_image** features);

#ifdef __GNUC__
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif

#endif
