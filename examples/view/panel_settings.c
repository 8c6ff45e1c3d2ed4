/* SPDX-License-Identifier: MIT
 *
 * Draws the settings of the technique: for each a slider or a choice, its unit and a reset button.
 */
#include "gui.h"
#include "setting_table.h"
#include "viewer.h"
#include "words.h"

#include <math.h>
#include <stdio.h>

/* The upper end of a slider. For a length it is ten times the default for the scene's suggested radius. */
static float slider_end(const setting *s, const viewer *v, float standard)
{
    const float suggested = camera_suggest_radius(v->scene);
    const bool is_far =
        s->offset == offsetof(glssao_settings, fade_far_start) || s->offset == offsetof(glssao_settings, fade_far_end);
    if (is_far)
        return 40 * suggested; /* two diagonals of the scene */
    if (s->offset == offsetof(glssao_settings, radius) && v->settings.radius_in_pixels)
        return 10 * SETTING_PIXELS;
    if (s->offset == offsetof(glssao_settings, thickness))
        return 10;
    if (!s->length)
        return s->high;
    return s->offset == offsetof(glssao_settings, radius) ? 10 * suggested : fmaxf(10 * standard, suggested);
}

static int most_samples(const viewer *v)
{
    return v->settings.technique == GLSSAO_CLASSIC ? 14 : 64;
}

static bool draw_samples(viewer *v, int standard)
{
    static const int counts[] = {12, 16, 24, 32, 48, 64};
    if (v->settings.technique != GLSSAO_HORIZON)
        return gui_slider_whole("samples", "a pixel", &v->settings.sample_count, 1, most_samples(v), standard);
    int at = 0;
    for (int i = 0; i < 6; i++)
        if (counts[i] == v->settings.sample_count)
            at = i;
    const bool changed = gui_choice("samples, a pixel", &at, "12|16|24|32|48|64");
    v->settings.sample_count = counts[at];
    if (gui_reset("samples", counts[at] != standard)) {
        v->settings.sample_count = standard;
        return true;
    }
    return changed;
}

static bool draw_setting(viewer *v, const setting *s, const glssao_settings *standard)
{
    void *at = (char *)&v->settings + s->offset;
    const void *from = (const char *)standard + s->offset;
    bool changed = false;
    switch (s->kind) {
    case SETTING_NUMBER: {
        float value = *(float *)at;
        const bool is_radius = s->offset == offsetof(glssao_settings, radius);
        const float usual = !is_radius                     ? *(const float *)from
                            : v->settings.radius_in_pixels ? (float)SETTING_PIXELS
                                                           : camera_suggest_radius(v->scene);
        changed = gui_slider(s->name, s->unit, &value, s->low, slider_end(s, v, usual), s->length, usual);
        if (changed && is_radius && !v->settings.radius_in_pixels)
            setting_scale_radius(&v->settings, value);
        else if (changed)
            *(float *)at = value;
        break;
    }
    case SETTING_WHOLE:
        changed = s->offset == offsetof(glssao_settings, sample_count)
                      ? draw_samples(v, *(const int *)from)
                      : gui_slider_whole(s->name, s->unit, at, (int)s->low, (int)s->high, *(const int *)from);
        break;
    case SETTING_SWITCH:
        changed = gui_check(s->name, at);
        if (gui_reset(s->name, *(bool *)at != *(const bool *)from)) {
            *(bool *)at = *(const bool *)from;
            changed = true;
        }
        if (changed && s->offset == offsetof(glssao_settings, radius_in_pixels))
            v->settings.radius = *(bool *)at ? (float)SETTING_PIXELS : camera_suggest_radius(v->scene);
        break;
    case SETTING_WORD: {
        int value = *(int *)at;
        changed = gui_choice(s->name, &value, s->words);
        if (gui_reset(s->name, value != *(const int *)from)) {
            value = *(const int *)from;
            changed = true;
        }
        *(int *)at = value;
        break;
    }
    }
    gui_tip(s->help);
    return changed;
}

/* Rays that correct another technique, and how far the tracing is. */
static bool draw_rays(viewer *v)
{
    bool changed = false;
    if (v->settings.technique != GLSSAO_RAYS) {
        changed = gui_slider_whole("rays", "a pixel and round", &v->options.rays, 0, 16, 0);
        gui_tip("Rays that correct this technique while the view rests. 0: none.");
    }
    if (rays_view_applies(v)) {
        char text[64];
        changed = gui_check("adaptive rays", &v->options.adaptive_rays) || changed;
        gui_tip("More rays where few neighbours can be averaged, fewer where all say the same.");
        snprintf(text, sizeof text, "rays: %d of %d rounds", v->rays_rounds, (int)RAY_ROUNDS);
        gui_progress((float)v->rays_rounds / (float)RAY_ROUNDS, text);
    }
    return changed;
}

void panel_draw_settings(viewer *v)
{
    if (!gui_section("Occlusion", true))
        return;
    int technique = v->options.technique, quality = v->options.quality;
    const bool chosen =
        gui_choice("technique (Tab)", &technique, GLSSAO_HAS_EMBREE ? ALL_TECHNIQUE_WORDS : TECHNIQUE_WORDS);
    if (gui_choice("quality (Shift+Tab)", &quality, QUALITY_WORDS) || chosen)
        viewer_set_technique(v, technique, quality);
    const glssao_settings standard = viewer_standard(v);
    bool changed = false;
    for (int i = 0; i < setting_count; i++)
        if (setting_table[i].techniques & 1u << v->settings.technique)
            changed = draw_setting(v, &setting_table[i], &standard) || changed;
    changed = (GLSSAO_HAS_EMBREE && draw_rays(v)) || changed;
    if (gui_button("Default settings")) {
        v->settings = standard;
        changed = true;
    }
    gui_same_line();
    if (gui_button("Suggested radius (R)")) {
        setting_scale_radius(&v->settings, camera_suggest_radius(v->scene));
        changed = true;
    }
    if (changed) {
        v->options.radius = (option_number){true, v->settings.radius};
        viewer_change(v);
    }
}
