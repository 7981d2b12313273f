/* Writes the samples of a renderer into a raw sample file (docs/file-format.md), for `rpf` to filter. All of it is this
 * file: C99 and C++17, nothing but POSIX, no code to link (older systems: -pthread). Include it before the system's
 * headers where the compiler is strict (-std=c99). docs/renderers.md has a renderer of 40 lines that uses it.
 *
 *     const char* channels[] = {"R", "G", "B", "film.X", "film.Y", "random.lens.U", "random.lens.V"};
 *     rpf_samples* file = rpf_samples_open("frame.rpf", 0, 0, width, height, channels, 7);
 *     rpf_samples_add(file, x, y, 1, record);                 // from any thread, in any order, as often as you like
 *     if (rpf_samples_finish(file) != RPF_SAMPLES_OK) puts(rpf_samples_error(file));
 *     rpf_samples_free(file);
 *
 * Errors stay: after one, nothing is written, and finish tells the first; so a renderer need not look at other results.
 * The file has its name when finish has succeeded, until then the old file of that name stays. Samples wait in a
 * nameless file beside it: while finish works, the disk holds them twice. Memory: at most 100 MB, 4 bytes a pixel, and
 * a two-thousandth of the samples. The order of samples in a pixel is that in which they were added. */
#ifndef RPF_SAMPLES_H
#define RPF_SAMPLES_H

#ifndef _DEFAULT_SOURCE
#define _DEFAULT_SOURCE 1 /* what POSIX adds to C99 */
#endif
#ifndef _FILE_OFFSET_BITS
#define _FILE_OFFSET_BITS 64 /* files beyond 2 GB on every system */
#endif
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>
#if defined(__GLIBC__) && !defined(__USE_MISC)
#error "include rpf_samples.h before the system's headers, or compile with -D_DEFAULT_SOURCE"
#endif

typedef struct rpf_samples rpf_samples;

enum rpf_samples_result {
  RPF_SAMPLES_OK = 0,
  RPF_SAMPLES_USAGE = 1,  /* an argument is not as described below */
  RPF_SAMPLES_OUTPUT = 2, /* a folder that is missing or may not be written to, a full disk, ... */
  RPF_SAMPLES_MEMORY = 3  /* the system gives no memory */
};

/* Begins a file. The data window is x, y (may be negative), width, height (at least 1) in pixels. channels: their
 * names, distinct, 1 to 255 bytes of UTF-8, at most 1024: the slots of docs/file-format.md. Missing folders and the
 * like are found here. Never fails visibly: the result may be handed to all functions below, also where it is NULL. */
static inline rpf_samples* rpf_samples_open(const char* path, int x, int y, int width, int height,
                                            const char* const* channels, int channel_count);

/* What is known of the whole frame, as docs/file-format.md lists it ("rpf:renderer", "rpf:seed", "rpf:worldOrigin"),
 * each name once, from one thread. Floats must be finite. */
static inline int rpf_samples_text(rpf_samples* file, const char* name, const char* text);
static inline int rpf_samples_integer(rpf_samples* file, const char* name, int value);
static inline int rpf_samples_floats(rpf_samples* file, const char* name, const float* values, int count);

/* Adds `count` samples to pixel (x, y) of the data window: records[sample * channel_count + channel]. NaN stands for a
 * value that a sample does not have. From any thread; a call for all samples of a pixel is faster than one for each. */
static inline int rpf_samples_add(rpf_samples* file, int x, int y, int count, const float* records);

/* Adds samples to all pixels of row y, for renderers that keep a plane for each channel: planes[channel] holds all
 * samples of the row's first pixel, then all of the second, ... counts: how many each pixel gets; NULL is one each.
 * From any thread. */
static inline int rpf_samples_add_row(rpf_samples* file, int y, const int* counts, const float* const* planes);

/* Writes the file, when all threads are done. Returns the first error of all calls so far. */
static inline int rpf_samples_finish(rpf_samples* file);

/* The first error as a sentence, "" where there was none. Lives as long as `file`. */
static inline const char* rpf_samples_error(const rpf_samples* file);

/* Gives everything back. Without a finish before, nothing was written. */
static inline void rpf_samples_free(rpf_samples* file);

/* ---- how it is done: samples are collected in blocks, each of a band of neighboring pixels; full blocks go to the
 * spool, a file without a name. finish reads band after band, sorts it by pixel, and writes a stretch of every plane.
 * -------- */

enum {
  rpf_raw_host_bytes = 80,        /* of a machine in a hidden name */
  rpf_raw_bands = 4096,           /* at most; so many blocks can be in memory */
  rpf_raw_band_pixels = 1024,     /* at least; less would write too short stretches */
  rpf_raw_block_bytes = 1 << 14,  /* bands * block: 64 MB */
  rpf_raw_slice_bytes = 1 << 24,  /* what is sorted at once; a band of 2,000 pixels with 64 samples of 26 floats fits */
  rpf_raw_header_bytes = 1 << 20, /* a longer first line is not read */
  rpf_raw_channels = 1024,
  rpf_raw_side = 1 << 20,    /* longest side of a window, in pixels */
  rpf_raw_farthest = 1 << 29 /* of its corner, from the origin */
};

/* A block holds records of one size: the pixel's number in its band (32 bits), then a float a channel. */
typedef struct {
  pthread_mutex_t lock;
  unsigned char* block; /* NULL before the first sample */
  size_t block_used;    /* records */
  off_t* spooled;       /* where the full blocks lie in the spool, in their order */
  size_t spooled_count, spooled_capacity;
} rpf_raw_band;

typedef struct {
  char* bytes;
  size_t size, capacity;
} rpf_raw_line;

struct rpf_samples {
  int x, y, width, height;
  size_t channel_count, pixel_count, band_count, band_pixels, record_bytes, block_records;
  uint32_t* counts;
  rpf_raw_band* bands; /* NULL where open failed */
  rpf_raw_line header, metadata;
  char *path, *place, *temporary; /* as given; behind symbolic links; what becomes `place` */
  int output, spool, finished;
  off_t spool_end;
  pthread_mutex_t lock; /* of spool_end, status, error */
  int status;
  char error[1024];
};

/* The first error is kept. Returns the status that the call ends with. */
static inline int rpf_raw_fail(rpf_samples* file, int status, const char* format, ...) {
  pthread_mutex_lock(&file->lock);
  if (file->status == RPF_SAMPLES_OK) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(file->error, sizeof file->error, format, arguments);
    va_end(arguments);
    file->status = status;
  }
  pthread_mutex_unlock(&file->lock);
  return status;
}

static inline int rpf_raw_no_memory(rpf_samples* file) {
  return rpf_raw_fail(file, RPF_SAMPLES_MEMORY, "\"%s\" cannot be written: no memory; close other programs",
                      file->path);
}

static inline int rpf_raw_cannot_write(rpf_samples* file, int error) {
  const char* remedy = "check the path and the disk";
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) remedy = "free space or choose another folder";
  if (error == EACCES || error == EPERM || error == EROFS) remedy = "choose a folder that may be written to";
  if (error == ENOENT || error == ENOTDIR) remedy = "make the folder first or correct the path";
  return rpf_raw_fail(file, RPF_SAMPLES_OUTPUT, "\"%s\" cannot be written: %s; %s", file->path, strerror(error),
                      remedy);
}

/* ---- the first line ---- */

/* Appends; where there is no memory, bytes becomes NULL and stays so. */
static inline void rpf_raw_append(rpf_raw_line* line, const char* text, size_t size) {
  if (line->size + size + 1 > line->capacity) {
    if (line->capacity > 0 && line->bytes == NULL) return;
    line->capacity = (line->size + size + 1) * 2;
    char* larger = (char*)realloc(line->bytes, line->capacity);
    if (larger == NULL) free(line->bytes);
    line->bytes = larger;
  }
  if (line->bytes == NULL) return;
  memcpy(line->bytes + line->size, text, size);
  line->size += size;
  line->bytes[line->size] = '\0';
}

static inline void rpf_raw_append_text(rpf_raw_line* line, const char* text) {
  rpf_raw_append(line, text, strlen(text));
}

/* As a JSON string. */
static inline void rpf_raw_append_quoted(rpf_raw_line* line, const char* text) {
  char escape[8];
  rpf_raw_append_text(line, "\"");
  for (; *text != '\0'; ++text) {
    const unsigned char letter = (unsigned char)*text;
    if (letter == '"' || letter == '\\') rpf_raw_append_text(line, "\\");
    if (letter < 0x20 || letter == 0x7f) {
      snprintf(escape, sizeof escape, "\\u%04x", letter);
      rpf_raw_append_text(line, escape);
    } else {
      rpf_raw_append(line, text, 1);
    }
  }
  rpf_raw_append_text(line, "\"");
}

/* With a point or an exponent, which makes it a float, and with a point in every locale. */
static inline void rpf_raw_append_float(rpf_raw_line* line, float value) {
  char number[32];
  snprintf(number, sizeof number, "%.9g", (double)value);
  for (char* letter = number; *letter != '\0'; ++letter)
    if (strchr("+-0123456789e", *letter) == NULL) *letter = '.';
  rpf_raw_append_text(line, number);
  if (strpbrk(number, ".e") == NULL) rpf_raw_append_text(line, ".0");
}

static inline int rpf_raw_is_name(const char* text) {
  if (text == NULL || *text == '\0' || strlen(text) > 255) return 0;
  for (; *text != '\0'; ++text)
    if ((unsigned char)*text < 0x20 || *text == 0x7f) return 0;
  return 1;
}

static inline int rpf_raw_make_header(rpf_samples* file, const char* const* channels) {
  char window[64];
  snprintf(window, sizeof window, "[%d, %d, %d, %d]", file->x, file->y, file->width, file->height);
  rpf_raw_append_text(&file->header, "{\"format\": \"rpf-raw-samples\", \"version\": 1, \"dataWindow\": ");
  rpf_raw_append_text(&file->header, window);
  rpf_raw_append_text(&file->header, ", \"channels\": [");
  for (size_t c = 0; c < file->channel_count; ++c) {
    if (!rpf_raw_is_name(channels[c]))
      return rpf_raw_fail(file, RPF_SAMPLES_USAGE,
                          "\"%s\": channel %d has no name of 1 to 255 bytes without control characters; name it as "
                          "docs/file-format.md does",
                          file->path, (int)c);
    for (size_t other = 0; other < c; ++other)
      if (strcmp(channels[c], channels[other]) == 0)
        return rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": the channel %s is there twice; name each once",
                            file->path, channels[c]);
    if (c > 0) rpf_raw_append_text(&file->header, ", ");
    rpf_raw_append_quoted(&file->header, channels[c]);
  }
  rpf_raw_append_text(&file->header, "], \"metadata\": {");
  return RPF_SAMPLES_OK;
}

/* Begins a value of the metadata. */
static inline int rpf_raw_begin_metadata(rpf_samples* file, const char* name) {
  if (file == NULL) return RPF_SAMPLES_MEMORY;
  if (file->bands == NULL || file->finished) return file->status;
  if (!rpf_raw_is_name(name))
    return rpf_raw_fail(file, RPF_SAMPLES_USAGE,
                        "\"%s\": metadata needs a name of 1 to 255 bytes without control characters", file->path);
  if (file->metadata.size > 0) rpf_raw_append_text(&file->metadata, ", ");
  rpf_raw_append_quoted(&file->metadata, name);
  rpf_raw_append_text(&file->metadata, ": ");
  return RPF_SAMPLES_OK;
}

static inline int rpf_samples_text(rpf_samples* file, const char* name, const char* text) {
  const int status = rpf_raw_begin_metadata(file, name);
  if (status == RPF_SAMPLES_OK) rpf_raw_append_quoted(&file->metadata, text);
  return status;
}

static inline int rpf_samples_integer(rpf_samples* file, const char* name, int value) {
  char number[16];
  const int status = rpf_raw_begin_metadata(file, name);
  snprintf(number, sizeof number, "%d", value);
  if (status == RPF_SAMPLES_OK) rpf_raw_append_text(&file->metadata, number);
  return status;
}

static inline int rpf_samples_floats(rpf_samples* file, const char* name, const float* values, int count) {
  const int status = rpf_raw_begin_metadata(file, name);
  if (status != RPF_SAMPLES_OK) return status;
  rpf_raw_append_text(&file->metadata, "[");
  for (int i = 0; i < count; ++i) {
    if (!(values[i] - values[i] == 0))
      return rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": a value of %s is not finite, and JSON has no such number",
                          file->path, name);
    if (i > 0) rpf_raw_append_text(&file->metadata, ", ");
    rpf_raw_append_float(&file->metadata, values[i]);
  }
  rpf_raw_append_text(&file->metadata, "]");
  return RPF_SAMPLES_OK;
}

/* ---- files ---- */

/* Nonzero with errno where not all bytes were written: a full disk may take a part. */
static inline int rpf_raw_write(int descriptor, const void* data, size_t size, off_t position) {
  const char* bytes = (const char*)data;
  while (size > 0) {
    const ssize_t part = pwrite(descriptor, bytes, size, position);
    if (part < 0 && errno == EINTR) continue;
    if (part == 0) errno = ENOSPC; /* no progress and no reason given */
    if (part <= 0) return -1;
    bytes += part;
    size -= (size_t)part;
    position += part;
  }
  return 0;
}

static inline int rpf_raw_read(int descriptor, void* data, size_t size, off_t position) {
  char* bytes = (char*)data;
  while (size > 0) {
    const ssize_t part = pread(descriptor, bytes, size, position);
    if (part < 0 && errno == EINTR) continue;
    if (part == 0) errno = EIO; /* shorter than what was written */
    if (part <= 0) return -1;
    bytes += part;
    size -= (size_t)part;
    position += part;
  }
  return 0;
}

/* This machine, as rpf writes it into hidden names: its name, and a part of the number that its kernel drew at its
 * start. */
static inline void rpf_raw_host(char text[rpf_raw_host_bytes]) {
  char start[9] = "";
  char name[65] = "";
  char* letter;
  FILE* boot = fopen("/proc/sys/kernel/random/boot_id", "r");
  gethostname(name, sizeof name - 1);
  if (boot != NULL) {
    if (fgets(start, sizeof start, boot) == NULL) start[0] = 0;
    fclose(boot);
  }
  snprintf(text, rpf_raw_host_bytes, "%s_%s", name, start);
  for (letter = text; *letter != 0; ++letter)
    if (!((*letter >= '0' && *letter <= '9') || (*letter >= 'A' && *letter <= 'Z') ||
          (*letter >= 'a' && *letter <= 'z') || *letter == '-'))
      *letter = '_';
}

/* Makes a hidden file beside the target. Named and locked as rpf's own are, so that rpf removes what a killed renderer
 * left, and nothing that is being written. `name` must hold the target's length + 64 +
 * rpf_raw_host_bytes. Returns the descriptor. */
static inline int rpf_raw_make_file(const char* place, char* name, size_t name_size) {
  const char* slash = strrchr(place, '/');
  const char* extension = strrchr(slash != NULL ? slash : place, '.');
  const int folder = slash != NULL ? (int)(slash - place) + 1 : 0;
  char host[rpf_raw_host_bytes];
  rpf_raw_host(host);
  for (int number = 0;; ++number) {
    struct stat opened, named;
    snprintf(name, name_size, "%.*s.rpf-%s-%ld-%d%s", folder, place, host, (long)getpid(), number,
             extension != NULL ? extension : "");
    const int descriptor = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) return -1;
    if (descriptor < 0) continue;
    /* Between its creation and its lock rpf may have removed it. */
    if (flock(descriptor, LOCK_EX) != 0) return descriptor; /* a file system without locks */
    if (fstat(descriptor, &opened) == 0 && stat(name, &named) == 0 && opened.st_ino == named.st_ino) return descriptor;
    close(descriptor);
  }
}

static inline int rpf_raw_make_files(rpf_samples* file) {
  struct stat existing;
  char* behind_links = realpath(file->path, NULL);
  if (behind_links != NULL) {
    free(file->place);
    file->place = behind_links;
  }
  if (stat(file->place, &existing) == 0 && !S_ISREG(existing.st_mode))
    return rpf_raw_fail(file, RPF_SAMPLES_OUTPUT,
                        "\"%s\" is a folder or a device, but samples need a regular file; give the name of a file",
                        file->path);
  const size_t size = strlen(file->place) + 64 + rpf_raw_host_bytes;
  file->temporary = (char*)malloc(size);
  if (file->temporary == NULL) return rpf_raw_no_memory(file);
  file->spool = rpf_raw_make_file(file->place, file->temporary, size);
  if (file->spool < 0) return rpf_raw_cannot_write(file, errno);
  unlink(file->temporary); /* it goes when it is closed, however the process ends */
  file->output = rpf_raw_make_file(file->place, file->temporary, size);
  return file->output < 0 ? rpf_raw_cannot_write(file, errno) : RPF_SAMPLES_OK;
}

/* ---- open, free ---- */

static inline int rpf_raw_make_bands(rpf_samples* file) {
  file->pixel_count = (size_t)file->width * (size_t)file->height;
  file->band_pixels = (file->pixel_count + rpf_raw_bands - 1) / rpf_raw_bands;
  if (file->band_pixels < rpf_raw_band_pixels) file->band_pixels = rpf_raw_band_pixels;
  file->band_count = (file->pixel_count + file->band_pixels - 1) / file->band_pixels;
  file->record_bytes = sizeof(uint32_t) + file->channel_count * sizeof(float);
  file->block_records = rpf_raw_block_bytes / file->record_bytes;
  file->counts = (uint32_t*)calloc(file->pixel_count, sizeof *file->counts);
  rpf_raw_band* bands = (rpf_raw_band*)calloc(file->band_count, sizeof *bands);
  if (file->counts == NULL || bands == NULL) {
    free(bands);
    return rpf_raw_no_memory(file);
  }
  for (size_t b = 0; b < file->band_count; ++b) pthread_mutex_init(&bands[b].lock, NULL);
  file->bands = bands;
  return RPF_SAMPLES_OK;
}

static inline rpf_samples* rpf_samples_open(const char* path, int x, int y, int width, int height,
                                            const char* const* channels, int channel_count) {
  rpf_samples* file = (rpf_samples*)calloc(1, sizeof *file);
  if (file == NULL) return NULL;
  pthread_mutex_init(&file->lock, NULL);
  file->x = x, file->y = y, file->width = width, file->height = height;
  file->channel_count = channel_count < 0 ? 0 : (size_t)channel_count;
  file->output = file->spool = -1;
  file->path = strdup(path);
  file->place = strdup(path);
  if (file->path == NULL || file->place == NULL)
    rpf_raw_fail(file, RPF_SAMPLES_MEMORY, "no memory for the name of a file");
  else if (width < 1 || height < 1 || width > rpf_raw_side || height > rpf_raw_side)
    rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": %d x %d pixels, expected 1 to %d each", path, width, height,
                 rpf_raw_side);
  else if (x < -rpf_raw_farthest || x > rpf_raw_farthest || y < -rpf_raw_farthest || y > rpf_raw_farthest)
    rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": a window at %d, %d, expected within %d pixels", path, x, y,
                 rpf_raw_farthest);
  else if (channel_count < 1 || channel_count > rpf_raw_channels)
    rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": %d channels, expected 1 to %d", path, channel_count,
                 rpf_raw_channels);
  else if (rpf_raw_make_header(file, channels) == RPF_SAMPLES_OK && rpf_raw_make_files(file) == RPF_SAMPLES_OK)
    rpf_raw_make_bands(file);
  return file;
}

static inline const char* rpf_samples_error(const rpf_samples* file) {
  return file == NULL ? "no memory for a sample file" : file->error;
}

static inline void rpf_samples_free(rpf_samples* file) {
  if (file == NULL) return;
  if (file->output >= 0 && file->temporary != NULL) unlink(file->temporary);
  if (file->output >= 0) close(file->output);
  if (file->spool >= 0) close(file->spool);
  for (size_t b = 0; file->bands != NULL && b < file->band_count; ++b) {
    pthread_mutex_destroy(&file->bands[b].lock);
    free(file->bands[b].block);
    free(file->bands[b].spooled);
  }
  pthread_mutex_destroy(&file->lock);
  free(file->bands);
  free(file->counts);
  free(file->header.bytes);
  free(file->metadata.bytes);
  free(file->path);
  free(file->place);
  free(file->temporary);
  free(file);
}

/* ---- add ---- */

/* Puts the full block of a band, whose lock is held, into the spool. */
static inline int rpf_raw_spool(rpf_samples* file, rpf_raw_band* band) {
  const size_t size = file->block_records * file->record_bytes;
  band->block_used = 0; /* also after an error: the file will not be written */
  if (band->spooled_count == band->spooled_capacity) {
    const size_t capacity = band->spooled_capacity * 2 + 4;
    off_t* larger = (off_t*)realloc(band->spooled, capacity * sizeof *larger);
    if (larger == NULL) return rpf_raw_no_memory(file);
    band->spooled = larger;
    band->spooled_capacity = capacity;
  }
  pthread_mutex_lock(&file->lock);
  const off_t position = file->spool_end;
  file->spool_end += (off_t)size;
  pthread_mutex_unlock(&file->lock);
  if (rpf_raw_write(file->spool, band->block, size, position) != 0) return rpf_raw_cannot_write(file, errno);
  band->spooled[band->spooled_count++] = position;
  return RPF_SAMPLES_OK;
}

/* Adds samples to a pixel of a band whose lock is held. */
static inline int rpf_raw_add(rpf_samples* file, rpf_raw_band* band, size_t pixel, int count, const float* records) {
  const uint32_t pixel_in_band = (uint32_t)(pixel % file->band_pixels);
  if (band->block == NULL) band->block = (unsigned char*)malloc(rpf_raw_block_bytes);
  if (band->block == NULL) return rpf_raw_no_memory(file);
  for (int s = 0; s < count; ++s) {
    if (band->block_used == file->block_records) {
      const int status = rpf_raw_spool(file, band);
      if (status != RPF_SAMPLES_OK) return status;
    }
    unsigned char* record = band->block + band->block_used++ * file->record_bytes;
    memcpy(record, &pixel_in_band, sizeof pixel_in_band);
    memcpy(record + sizeof pixel_in_band, records + (size_t)s * file->channel_count,
           file->channel_count * sizeof(float));
    ++file->counts[pixel];
  }
  return RPF_SAMPLES_OK;
}

static inline int rpf_samples_add(rpf_samples* file, int x, int y, int count, const float* records) {
  if (file == NULL) return RPF_SAMPLES_MEMORY;
  if (file->bands == NULL) return file->status;
  const long long column = (long long)x - file->x, row = (long long)y - file->y;
  if (column < 0 || column >= file->width || row < 0 || row >= file->height || count < 0 || file->finished)
    return rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": %d samples for pixel %d, %d %s", file->path, count, x, y,
                        file->finished ? "after the file was finished"
                        : count < 0    ? "are no number of samples"
                                       : "lie outside the data window");
  const size_t pixel = (size_t)row * (size_t)file->width + (size_t)column;
  rpf_raw_band* band = &file->bands[pixel / file->band_pixels];
  pthread_mutex_lock(&band->lock);
  const int status = rpf_raw_add(file, band, pixel, count, records);
  pthread_mutex_unlock(&band->lock);
  return status;
}

static inline int rpf_samples_add_row(rpf_samples* file, int y, const int* counts, const float* const* planes) {
  float record[rpf_raw_channels];
  size_t sample = 0;
  if (file == NULL || file->bands == NULL) return file == NULL ? RPF_SAMPLES_MEMORY : file->status;
  for (int x = 0; x < file->width; ++x)
    for (int s = 0; s < (counts == NULL ? 1 : counts[x]); ++s, ++sample) {
      for (size_t c = 0; c < file->channel_count; ++c) record[c] = planes[c][sample];
      const int status = rpf_samples_add(file, file->x + x, y, 1, record);
      if (status != RPF_SAMPLES_OK) return status;
    }
  return RPF_SAMPLES_OK;
}

/* ---- finish ---- */

/* What finish works with. Samples are numbered in the order of pixels. */
typedef struct {
  off_t planes;        /* where in the output the first plane begins */
  uint64_t total;      /* samples of the frame */
  uint64_t band_first; /* the first sample of the band */
  size_t begin, end;   /* the slice of the band's samples that is sorted now */
  uint32_t* next;      /* of each pixel of the band: where in the band its next sample goes */
  unsigned char* block;
  unsigned char* slice; /* slice_samples little-endian values of each channel */
  size_t slice_samples;
} rpf_raw_sorting;

static inline void rpf_raw_put_word(unsigned char* to, uint32_t word) {
  for (int byte = 0; byte < 4; ++byte) to[byte] = (unsigned char)(word >> (8 * byte));
}

/* Puts those records of a block that belong to the slice into their places. */
static inline void rpf_raw_sort_block(const rpf_samples* file, rpf_raw_sorting* sorting, const unsigned char* block,
                                      size_t records) {
  for (size_t r = 0; r < records; ++r) {
    const unsigned char* record = block + r * file->record_bytes;
    uint32_t word;
    memcpy(&word, record, sizeof word);
    const size_t place = sorting->next[word]++;
    if (place < sorting->begin || place >= sorting->end) continue;
    for (size_t c = 0; c < file->channel_count; ++c) {
      memcpy(&word, record + (c + 1) * sizeof word, sizeof word);
      rpf_raw_put_word(sorting->slice + (c * sorting->slice_samples + place - sorting->begin) * sizeof word, word);
    }
  }
}

/* One slice of a band's samples: all its blocks are read, and a stretch of every plane is written. */
static inline int rpf_raw_write_slice(rpf_samples* file, const rpf_raw_band* band, rpf_raw_sorting* sorting) {
  for (size_t b = 0; b < band->spooled_count; ++b) {
    if (rpf_raw_read(file->spool, sorting->block, file->block_records * file->record_bytes, band->spooled[b]) != 0)
      return rpf_raw_cannot_write(file, errno);
    rpf_raw_sort_block(file, sorting, sorting->block, file->block_records);
  }
  rpf_raw_sort_block(file, sorting, band->block, band->block_used);
  for (size_t c = 0; c < file->channel_count; ++c) {
    const uint64_t first = c * sorting->total + sorting->band_first + sorting->begin;
    if (rpf_raw_write(file->output, sorting->slice + c * sorting->slice_samples * 4,
                      (sorting->end - sorting->begin) * 4, sorting->planes + (off_t)(first * 4)) != 0)
      return rpf_raw_cannot_write(file, errno);
  }
  return RPF_SAMPLES_OK;
}

static inline int rpf_raw_write_band(rpf_samples* file, size_t b, rpf_raw_sorting* sorting) {
  const size_t first_pixel = b * file->band_pixels, rest = file->pixel_count - first_pixel;
  const size_t pixels = rest < file->band_pixels ? rest : file->band_pixels;
  size_t samples = 0;
  for (size_t p = 0; p < pixels; ++p) samples += file->counts[first_pixel + p];
  for (sorting->begin = 0; sorting->begin < samples; sorting->begin = sorting->end) {
    uint32_t next = 0;
    for (size_t p = 0; p < pixels; next += file->counts[first_pixel + p++]) sorting->next[p] = next;
    sorting->end = sorting->begin + sorting->slice_samples;
    if (sorting->end > samples) sorting->end = samples;
    if (rpf_raw_write_slice(file, &file->bands[b], sorting) != RPF_SAMPLES_OK) return file->status;
  }
  sorting->band_first += samples;
  return RPF_SAMPLES_OK;
}

/* The first line and the counts, through the slice, which is free as yet. */
static inline int rpf_raw_write_counts(rpf_samples* file, rpf_raw_sorting* sorting) {
  const size_t words = rpf_raw_slice_bytes / 4;
  if (rpf_raw_write(file->output, file->header.bytes, file->header.size, 0) != 0)
    return rpf_raw_cannot_write(file, errno);
  sorting->planes = (off_t)file->header.size;
  for (size_t begin = 0, end; begin < file->pixel_count; begin = end) {
    end = file->pixel_count - begin < words ? file->pixel_count : begin + words;
    for (size_t p = begin; p < end; ++p) {
      rpf_raw_put_word(sorting->slice + (p - begin) * 4, file->counts[p]);
      sorting->total += file->counts[p];
    }
    if (rpf_raw_write(file->output, sorting->slice, (end - begin) * 4, sorting->planes) != 0)
      return rpf_raw_cannot_write(file, errno);
    sorting->planes += (off_t)((end - begin) * 4);
  }
  if (sorting->total > UINT32_MAX - 1)
    return rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": more than 4,294,967,294 samples; write parts of the frame",
                        file->path);
  return RPF_SAMPLES_OK;
}

static inline int rpf_raw_write_all(rpf_samples* file, rpf_raw_sorting* sorting) {
  const int metadata_lost = file->metadata.capacity > 0 && file->metadata.bytes == NULL;
  if (file->metadata.bytes != NULL) rpf_raw_append(&file->header, file->metadata.bytes, file->metadata.size);
  rpf_raw_append_text(&file->header, "}}\n");
  if (metadata_lost || file->header.bytes == NULL || sorting->next == NULL || sorting->block == NULL ||
      sorting->slice == NULL)
    return rpf_raw_no_memory(file);
  if (file->header.size > rpf_raw_header_bytes)
    return rpf_raw_fail(file, RPF_SAMPLES_USAGE, "\"%s\": names and metadata take more than 1 MB", file->path);
  if (rpf_raw_write_counts(file, sorting) != RPF_SAMPLES_OK) return file->status;
  for (size_t b = 0; b < file->band_count; ++b)
    if (rpf_raw_write_band(file, b, sorting) != RPF_SAMPLES_OK) return file->status;
  return RPF_SAMPLES_OK;
}

/* The new name lasts only when the file and its folder are on the disk. */
static inline int rpf_raw_rename(rpf_samples* file) {
  if (fsync(file->output) != 0 || rename(file->temporary, file->place) != 0) return rpf_raw_cannot_write(file, errno);
  char* slash = strrchr(file->place, '/');
  if (slash != NULL) slash[1] = '\0';
  const int folder = open(slash != NULL ? file->place : ".", O_RDONLY | O_CLOEXEC);
  if (folder >= 0) fsync(folder); /* some network file systems cannot; the file itself is safe */
  if (folder >= 0) close(folder);
  free(file->temporary); /* nothing left to remove */
  file->temporary = NULL;
  return RPF_SAMPLES_OK;
}

static inline int rpf_samples_finish(rpf_samples* file) {
  if (file == NULL) return RPF_SAMPLES_MEMORY;
  if (file->status != RPF_SAMPLES_OK || file->finished) return file->status;
  rpf_raw_sorting sorting;
  memset(&sorting, 0, sizeof sorting);
  sorting.slice_samples = rpf_raw_slice_bytes / 4 / file->channel_count;
  sorting.next = (uint32_t*)malloc(file->band_pixels * sizeof *sorting.next);
  sorting.block = (unsigned char*)malloc(rpf_raw_block_bytes);
  sorting.slice = (unsigned char*)malloc(rpf_raw_slice_bytes);
  file->finished = 1;
  if (rpf_raw_write_all(file, &sorting) == RPF_SAMPLES_OK) rpf_raw_rename(file);
  free(sorting.next);
  free(sorting.block);
  free(sorting.slice);
  return file->status;
}

#endif
