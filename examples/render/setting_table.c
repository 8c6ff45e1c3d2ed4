/* SPDX-License-Identifier: MIT */
#include "setting_table.h"

#include "words.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    CLASSIC = 1 << GLSSAO_CLASSIC,
    HEMISPHERE = 1 << GLSSAO_HEMISPHERE,
    HORIZON = 1 << GLSSAO_HORIZON,
    ALL = CLASSIC | HEMISPHERE | HORIZON
};

#define AT(member) offsetof(glssao_settings, member)
const setting setting_table[] = {
    {"radius", "scene units", "largest distance of an occluder", SETTING_NUMBER, AT(radius), 0, 1e12f, true, NULL, ALL},
    {"radius-in-pixels", "", "let the radius count pixels of the full size, at any distance", SETTING_SWITCH,
     AT(radius_in_pixels), 0, 1, false, NULL, ALL},
    {"thickness", "factor", "multiplies the thickness that is estimated for occluders", SETTING_NUMBER, AT(thickness),
     0.001f, 1000, false, NULL, HORIZON},
    {"fade-far-start", "scene units", "view distance up to which occlusion is full", SETTING_NUMBER, AT(fade_far_start),
     0, 1e12f, false, NULL, ALL},
    {"fade-far-end", "scene units", "view distance from which on there is no occlusion; 0: never", SETTING_NUMBER,
     AT(fade_far_end), 0, 1e12f, false, NULL, ALL},
    {"power", "exponent", "contrast: accessibility is raised to this power", SETTING_NUMBER, AT(power), 0, 64, false,
     NULL, ALL},
    {"samples", "a pixel", "more samples give less noise and take more time", SETTING_WHOLE, AT(sample_count), 1, 64,
     false, NULL, ALL},
    {"half", "", "estimate occlusion at half size", SETTING_SWITCH, AT(half_resolution), 0, 1, false, NULL, ALL},
    {"upsample", "", "bring a half-size result to full size along surfaces", SETTING_SWITCH, AT(upsample), 0, 1, false,
     NULL, ALL},
    {"fade-start", "scene units", "occluders that are nearer to the camera by this much count fully", SETTING_NUMBER,
     AT(fade_start), 0, 1e12f, true, NULL, CLASSIC},
    {"fade-end", "scene units", "occluders that are nearer to the camera by more than this do not count",
     SETTING_NUMBER, AT(fade_end), 0, 1e12f, true, NULL, CLASSIC},
    {"epsilon", "scene units", "depths that differ by less than this hide nothing", SETTING_NUMBER, AT(surface_epsilon),
     0, 1e12f, true, NULL, ALL},
    {"blur", "", "how noise is smoothed", SETTING_WORD, AT(blur), 0, 4, false, BLUR_WORDS, ALL},
    {"blur-rounds", "rounds", "each round is a horizontal and a vertical pass", SETTING_WHOLE, AT(blur_rounds), 0, 16,
     false, NULL, ALL},
    {"blur-sigma", "pixels", "width of the Gaussian and bilateral blurs", SETTING_NUMBER, AT(blur_sigma), 0.1f, 2.5f,
     false, NULL, ALL},
    {"blur-normals", "cosine", "bilateral: drop taps whose normal differs so that the dot product is smaller",
     SETTING_NUMBER, AT(blur_normal_threshold), -1, 1, false, NULL, ALL},
    {"blur-depth", "scene units", "bilateral: drop taps whose view distance differs by more", SETTING_NUMBER,
     AT(blur_depth_threshold), 0, 1e12f, true, NULL, ALL},
    {"tiles", "", "find tiles that nothing can occlude, and skip them", SETTING_WORD, AT(tiles), 0, 2, false,
     TILES_WORDS, ALL},
    {"no-angle-weight", "", "for teaching: count occluders at any angle", SETTING_SWITCH, AT(no_angle_weight), 0, 1,
     false, NULL, CLASSIC},
    {"history", "frames", "reuse earlier frames: at most so many count in a pixel's mean; 0: none", SETTING_WHOLE,
     AT(history), 0, 63, false, NULL, ALL},
    {"noise-index", "", "another pattern of noise for each number", SETTING_WHOLE, AT(noise_index), 0, 1e6f, false,
     NULL, ALL},
    {"bent-normals", "", "also make the directions in which surfaces are open", SETTING_SWITCH, AT(bent_normals), 0, 1,
     false, NULL, HORIZON},
};
#undef AT
const int setting_count = sizeof setting_table / sizeof setting_table[0];

static bool take(const setting *s, const char *text, size_t length, glssao_settings *out)
{
    void *at = (char *)out + s->offset;
    char number[64];
    if (s->kind == SETTING_WORD) {
        const int value = words_find_span(s->words, text, length);
        *(int *)at = value >= 0 ? value : *(int *)at;
        return value >= 0;
    }
    if (s->kind == SETTING_SWITCH) {
        const int value = words_find_span("off|on", text, length);
        *(bool *)at = value >= 0 ? value > 0 : *(bool *)at;
        return value >= 0;
    }
    if (length == 0 || length >= sizeof number || !strchr("-.0123456789", text[0]))
        return false;
    memcpy(number, text, length);
    number[length] = '\0';
    char *end;
    const double value = strtod(number, &end);
    if (*end != '\0' || strpbrk(number, "xX") || !((float)value >= s->low && (float)value <= s->high))
        return false;
    if (s->kind == SETTING_NUMBER) {
        *(float *)at = (float)value;
        return true;
    }
    *(int *)at = (int)value;
    return value == floor(value);
}

bool setting_apply(const char *text, glssao_settings *settings, failure *why)
{
    while (*text) {
        const size_t length = strcspn(text, ","), name_length = strcspn(text, "=,");
        const setting *found = NULL;
        for (int i = 0; i < setting_count; i++)
            if (strlen(setting_table[i].name) == name_length && !memcmp(setting_table[i].name, text, name_length))
                found = &setting_table[i];
        if (!found || text[name_length] != '=')
            return fault_set(why, "\"%.*s\": unknown setting; write NAME=VALUE", (int)length, text);
        if (!take(found, text + name_length + 1, length - name_length - 1, settings))
            return fault_set(why, "\"%.*s\": not a valid value of %s", (int)length, text, found->name);
        text += length + (text[length] == ',');
    }
    return true;
}

static bool is_same(const setting *s, const glssao_settings *a, const glssao_settings *b)
{
    const size_t size = s->kind == SETTING_SWITCH ? sizeof(bool) : sizeof(int);
    return !memcmp((const char *)a + s->offset, (const char *)b + s->offset, size);
}

bool setting_differences(const glssao_settings *from, const glssao_settings *to, char *out, size_t out_size)
{
    size_t used = 0;
    out[0] = '\0';
    for (int i = 0; i < setting_count; i++) {
        const setting *s = &setting_table[i];
        const void *at = (const char *)to + s->offset;
        if (is_same(s, from, to))
            continue;
        char value[64];
        if (s->kind == SETTING_NUMBER)
            snprintf(value, sizeof value, "%.9g", (double)*(const float *)at);
        else if (s->kind == SETTING_WHOLE)
            snprintf(value, sizeof value, "%d", *(const int *)at);
        else if (s->kind == SETTING_SWITCH)
            snprintf(value, sizeof value, "%s", *(const bool *)at ? "on" : "off");
        else
            snprintf(value, sizeof value, "%s", words_at(s->words, *(const int *)at).text);
        const int written = snprintf(out + used, out_size - used, "%s%s=%s", used ? "," : "", s->name, value);
        if (written < 0 || (size_t)written >= out_size - used)
            return false;
        used += (size_t)written;
    }
    return true;
}

void setting_scale_radius(glssao_settings *settings, float radius)
{
    const float scale = radius > 0 && settings->radius > 0 ? radius / settings->radius : 1;
    for (int i = 0; i < setting_count; i++)
        if (setting_table[i].length)
            *(float *)((char *)settings + setting_table[i].offset) *= scale;
    settings->radius = radius;
}
