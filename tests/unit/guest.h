/* SPDX-License-Identifier: MIT
 *
 * What the tests of good manners share: a guest (an effect with a frame to read), a compatibility context, GL
 * functions outside the common table, and checks that a call left no GL error and said why it refused.
 */
#pragma once

#include "fixture.h"

enum { GUEST_W = 64, GUEST_H = 48 };

typedef struct guest {
    fixture *f;
    glssao_effect *effect;
    glssao_frame frame; /* a room, with normals */
} guest;

guest guest_open(fixture *f, glssao_path path);
void guest_close(guest *g);
#define test_end_guest guest_close /* for SCOPED */

/* As fixture_setup, with a context of the compatibility profile. */
int guest_setup_compatibility(void **state);
bool guest_is_compatibility(void);

/* Fills the pointer to a GL function of any version; fails where the context has none of that name. */
void guest_load(const fixture *f, const char *name, void *out_function);

/* Computes and reads the map back. The caller frees. */
float *guest_picture(guest *g, const glssao_frame *frame, const glssao_settings *settings);
/* Fails with `what` where a pixel differs by more than one step of R16. */
void guest_same_picture(const float *got, const float *wanted, const char *what);

/* Fails where GL holds an error. */
void guest_no_error(const char *what);
/* Fails unless the call gave INVALID_ARGUMENT, left no GL error and wrote exactly one log line that holds `word`. */
void guest_refused(guest *g, glssao_result result, const char *word, const char *what);

/* A white picture of the guest's size to apply to, bound. */
fixture_target guest_make_white(void);
/* Pixels that are white no longer. */
int guest_count_dark(const fixture_target *t);
