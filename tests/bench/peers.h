/* SPDX-License-Identifier: MIT
 *
 * Effects of npm packages as peers: node records what each draws for a view (peers/record.mjs), replay.h draws it.
 */
#pragma once

#include "replay.h"
#include "results.h"

/* The configurations: each peer with its documented defaults; each as NAME-best, with the multipliers of radius,
 * thickness and strength that bring it nearest to the truth; and, with `grid`, each with many multipliers: NAME@RxTxS;
 * some have the same name.
 */
int peers_count(bool grid);
void peers_name(int number, char name[48]);

typedef struct peer_view {
    const gbuffer *gbuffer;
    float radius, distance; /* scene units; median view distance */
} peer_view;

typedef struct peer_bench {
    const char *modules; /* node_modules; NULL: all was recorded before */
    replayer *replayer;
    char folder[1024]; /* of the recordings */
} peer_bench;

/* options.peers is node_modules, and recordings go to the cache; or it is a folder of recordings. */
bool peers_open(peer_bench *b, const options *o, context *c, failure *fault);
void peers_close(peer_bench *b);

/* Has node record these configurations for these views, except for what was recorded before. Without packages all must
 * have been. */
bool peers_record(peer_bench *b, const int *numbers, int number_count, const peer_view *views, int count,
                  failure *fault);
/* The same for the peers among r->configs. */
bool peers_record_configs(const results *r, const peer_view *views, int count, failure *fault);

/* Loads the recording of a configuration for a view; NULL, with one line in `error`. */
replay *peers_load(peer_bench *b, int number, const peer_view *v, failure *fault);

/* The median view distance of the pixels that show a surface; 1 where there are none. */
float peers_distance(const float *distance, size_t count);
