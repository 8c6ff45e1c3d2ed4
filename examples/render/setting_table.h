/* SPDX-License-Identifier: MIT
 *
 * The settings of the effect by name: one table for --set and for the sliders of the viewer.
 */
#pragma once

#include "fault.h"

#include <glssao/glssao.h>
#include <stddef.h>

typedef enum setting_kind { SETTING_NUMBER = 0, SETTING_WHOLE, SETTING_SWITCH, SETTING_WORD } setting_kind;

typedef struct setting {
    const char *name, *unit, *help; /* unit "": none */
    setting_kind kind;
    size_t offset;       /* into glssao_settings: float, int, bool, or an enum as int */
    float low, high;     /* allowed range; also the ends of the slider if `length` is false */
    bool length;         /* in scene units; scales with the radius */
    const char *words;   /* SETTING_WORD: separated by '|' */
    unsigned techniques; /* one bit for each technique that reads it */
} setting;

enum { SETTING_PIXELS = 32 }; /* the usual radius in pixels */

extern const setting setting_table[];
extern const int setting_count;

/* Sets what "name=value,name=value" says. False, with one line in `why`, if a name or value is wrong. */
bool setting_apply(const char *text, glssao_settings *settings, failure *why);

/* Writes the differences as such a text, "" if there are none. False if it does not fit. */
bool setting_differences(const glssao_settings *from, const glssao_settings *to, char *out, size_t out_size);

/* Sets the radius and scales the other lengths by the same factor. */
void setting_scale_radius(glssao_settings *settings, float radius);
