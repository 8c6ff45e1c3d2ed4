/* SPDX-License-Identifier: MIT
 *
 * Reads the environment and prints all messages to the user: lines on stderr that begin with "glssao-inject:".
 */
#define _POSIX_C_SOURCE 200809L
#include "inject.h"
#include "words.h"

#include <glssao/glssao.h>
#include <locale.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static inject_options options;
static pthread_once_t once = PTHREAD_ONCE_INIT;

/* The C locale; the program's own may have a decimal comma. */
static locale_t plain;

static void make_plain_locale(void)
{
    plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
}

inject_locale inject_use_plain_locale(void)
{
    static pthread_once_t made = PTHREAD_ONCE_INIT;
    pthread_once(&made, make_plain_locale);
    return (inject_locale){plain ? uselocale(plain) : NULL};
}

void inject_restore_locale(inject_locale before)
{
    if (before.handle)
        uselocale(before.handle);
}

void inject_say(const char *format, ...)
{
    const inject_locale before = inject_use_plain_locale();
    va_list arguments;
    va_start(arguments, format);
    fputs("glssao-inject: ", stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    inject_restore_locale(before);
}

static float number(const char *name, float least, float most)
{
    const char *text = getenv(name);
    if (!text || !*text)
        return 0.0f;
    char *end;
    const inject_locale before = inject_use_plain_locale();
    const float value = strtof(text, &end);
    inject_restore_locale(before);
    if (*end == '\0' && value >= least && value <= most)
        return value;
    inject_say("%s=%s is not a number from %g to %g and is not used", name, text, (double)least, (double)most);
    return 0.0f;
}

static bool flag(const char *name)
{
    const char *text = getenv(name);
    return text && *text && strcmp(text, "0") != 0;
}

static void read_environment(void)
{
    options = (inject_options){
        .fov = number("GLSSAO_INJECT_FOV", 1.0f, 179.0f),
        .near_plane = number("GLSSAO_INJECT_NEAR", 0.0f, 1e12f),
        .far_plane = number("GLSSAO_INJECT_FAR", 0.0f, 1e12f),
        .radius = number("GLSSAO_INJECT_RADIUS", 0.0f, 1e11f),
        .power = number("GLSSAO_INJECT_POWER", 0.0f, 64.0f),
        .off = flag("GLSSAO_INJECT_OFF"),
        .map = flag("GLSSAO_INJECT_MAP"),
        .picture = getenv("GLSSAO_INJECT_PICTURE"),
        .before = getenv("GLSSAO_INJECT_BEFORE"),
        .picture_frame = (int)number("GLSSAO_INJECT_FRAME", 1.0f, 1e6f),
    };
    if (options.picture_frame == 0)
        options.picture_frame = 100;
    const char *quality = getenv("GLSSAO_INJECT_QUALITY");
    const int level = quality && *quality ? words_find(QUALITY_WORDS, quality) : GLSSAO_HIGH;
    if (level < 0)
        inject_say("GLSSAO_INJECT_QUALITY=%s is none of " QUALITY_WORDS " and is not used", quality);
    options.quality = level < 0 ? GLSSAO_HIGH : level;
    const bool planes = options.near_plane > 0.0f && options.far_plane > options.near_plane;
    if ((options.fov > 0.0f) != planes) {
        inject_say("a projection needs all of GLSSAO_INJECT_FOV, GLSSAO_INJECT_NEAR above 0 and GLSSAO_INJECT_FAR "
                   "above it, and is not used");
        options.fov = 0.0f;
    }
}

const inject_options *inject_get_options(void)
{
    pthread_once(&once, read_environment);
    return &options;
}
