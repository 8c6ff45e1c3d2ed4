/* SPDX-License-Identifier: MIT */
#include "techniques.h"

configuration configuration_of(int number)
{
    static const char *const techniques[TECHNIQUES] = {"classic", "hemisphere", "horizon"};
    static const char *const qualities[QUALITIES] = {"low", "medium", "high", "ultra"};
    const int technique = number / (2 * QUALITIES), quality = number / 2 % QUALITIES, half = number % 2;
    configuration c = {.settings = glssao_default_settings((glssao_technique)technique, (glssao_quality)quality)};
    c.settings.half_resolution = half == 1;
    c.settings.upsample = half == 1;
    c.settings.power = 1.0f;
    snprintf(c.name, sizeof c.name, "%s %s at %s size", techniques[technique], qualities[quality],
             half ? "half" : "full");
    return c;
}

int configuration_stride(int argc, char **argv)
{
    const int stride = argc > 1 ? atoi(argv[1]) : 1;
    return stride > 0 ? stride : 1;
}

glssao_settings settings_scaled(const glssao_settings *settings, double scale)
{
    glssao_settings s = *settings;
    const float by = (float)scale;
    s.radius *= by;
    s.fade_start *= by;
    s.fade_end *= by;
    s.surface_epsilon *= by;
    s.blur_depth_threshold *= by;
    s.fade_far_start *= by;
    s.fade_far_end *= by;
    return s;
}

bool picture_is_sound(const picture *p)
{
    for (int i = 0; i < p->width * p->height; ++i)
        if (!(p->values[i] >= 0.0f && p->values[i] <= 1.0f)) { /* also true for NaN */
            print_error("pixel %d, %d is %g\n", i % p->width, i / p->width, (double)p->values[i]);
            return false;
        }
    return true;
}

double picture_least(const picture *p)
{
    double least = 1.0;
    for (int i = 0; i < p->width * p->height; ++i)
        least = fmin(least, (double)p->values[i]);
    return least;
}

double picture_mean(const picture *p)
{
    double sum = 0.0;
    for (int i = 0; i < p->width * p->height; ++i)
        sum += (double)p->values[i];
    return sum / (p->width * p->height);
}
