/* SPDX-License-Identifier: MIT
 *
 * Every technique at every quality, at half and full size: the configurations that each stability test runs.
 */
#pragma once

#include "subject.h"

enum { TECHNIQUES = 3, QUALITIES = 4, CONFIGURATIONS = TECHNIQUES * QUALITIES * 2 };

typedef struct configuration {
    char name[48];
    glssao_settings settings; /* lengths as for a radius of 0.5; contrast off */
} configuration;

configuration configuration_of(int number);
/* The stride through the configurations: a test's first argument, 1 without. Odd ones reach both half and full size. */
int configuration_stride(int argc, char **argv);

/* The settings with all lengths multiplied. */
glssao_settings settings_scaled(const glssao_settings *settings, double scale);

/* Whether every value is finite and within 0..1; prints the first that is not. */
bool picture_is_sound(const picture *p);
double picture_least(const picture *p);
double picture_mean(const picture *p);
