/* SPDX-License-Identifier: MIT
 *
 * Draws the passes of a peer's recording (peers/recording.mjs writes them).
 */
#pragma once

#include "context.h"
#include "gbuffer.h"

/* What a host hands to the peers, in the forms that they want. */
typedef enum replay_input {
    REPLAY_DEPTH = 0,           /* window depth */
    REPLAY_NORMALS,             /* view space, 0..1; where nothing is, three's clear colour */
    REPLAY_NORMALS_LEFT_HANDED, /* view space that looks down +z, -1..1; linear filter, as Babylon.js has it */
    REPLAY_DISTANCE,            /* view distance, 0 where nothing is; linear filter */
    REPLAY_WHITE,
    REPLAY_INPUTS
} replay_input;

typedef struct replay_inputs {
    GLuint textures[REPLAY_INPUTS]; /* REPLAY_DEPTH is the gbuffer's */
} replay_inputs;

/* False when memory is short; replay_inputs_destroy is due in either case. */
bool replay_inputs_create(replay_inputs *in, const gbuffer *g);
void replay_inputs_destroy(replay_inputs *in);

/* What all replays share: compiled programs, the triangle that is drawn, functions that gl.h lacks. */
typedef struct replayer replayer;
replayer *replayer_create(context *c);
void replayer_destroy(replayer *r);

typedef struct replay replay;
/* Loads a recording with its textures and programs; NULL, with one line in `error`. */
replay *replay_load(replayer *r, const char *folder, const char *key, failure *fault);
void replay_destroy(replay *p);
void replay_draw(replayer *r, const replay *p, const replay_inputs *in);
/* GPU time of one drawing among others, in milliseconds; NAN where there are no timestamps. */
double replay_gpu_ms(replayer *r, const replay *p, const replay_inputs *in);
/* The red channel of the output, at full size; false, with one line in `error`, where it has another size. */
bool replay_read(const replay *p, int width, int height, float *out, failure *fault);
