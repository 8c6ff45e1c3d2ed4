/* SPDX-License-Identifier: MIT
 *
 * The effect's settings by name: one table that --set and the viewer's sliders are made of.
 */
#ifndef GLSSAO_EXAMPLES_SETTING_TABLE_H
#define GLSSAO_EXAMPLES_SETTING_TABLE_H

#include "fault.h"

#include <glssao/glssao.h>
#include <stddef.h>

typedef enum setting_kind { SETTING_NUMBER = 0, SETTING_WHOLE, SETTING_SWITCH, SETTING_WORD } setting_kind;

typedef struct setting {
    const char *name, *unit, *help; /* unit: "" where it has none */
    setting_kind kind;
    size_t offset;       /* into glssao_settings: float, int, bool, or an enum as int */
    float low, high;     /* what it may be; a slider's ends, too, where `length` is false */
    bool length;         /* in scene units: scales with the radius */
    const char *words;   /* SETTING_WORD: separated by '|' */
    unsigned techniques; /* bit of each that reads it */
} setting;

extern const setting setting_table[];
extern const int setting_count;

/* "name=value,name=value" into *settings. False, with one line in `why`, where a name or value is wrong. */
bool setting_apply(const char *text, glssao_settings *settings, fault *why);

/* Writes what differs between the two as such a text, "" where nothing does; false where it does not fit. */
bool setting_differences(const glssao_settings *from, const glssao_settings *to, char *out, size_t out_size);

/* Sets the radius, and scales the other lengths along: they belong together. */
void setting_scale_radius(glssao_settings *settings, float radius);

#endif
