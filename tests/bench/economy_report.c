/* SPDX-License-Identifier: MIT
 *
 * The tables of glssao-economy.
 */
#include "economy.h"

#include "table.h"

#include <math.h>

static bool begin(table *t, const economy *e, const char *name, const char *columns, failure *fault)
{
    return table_begin(t, e->options, e->context, name, columns, fault);
}

static double mib(int64_t bytes)
{
    return (double)bytes / 1048576;
}

static bool write_tiles(const economy *e, failure *fault)
{
    table t;
    if (!begin(&t, e, "economy-tiles",
               "scene configuration every_ms skipping_ms skipped_share worst_steps every_programs skipping_programs "
               "every_mib skipping_mib",
               fault))
        return false;
    for (int i = 0; i < e->row_count; i++) {
        const economy_row *r = &e->rows[i];
        table_text(&t, r->name);
        table_text(&t, economy_config_name(r->config));
        TABLE_END_ROW(&t, r->ms[0], r->ms[1], r->skipped, r->worst, r->programs[0], r->programs[1], mib(r->bytes[0]),
                      mib(r->bytes[1]));
    }
    return table_end(&t, fault);
}

static bool write_frames(const economy *e, failure *fault)
{
    table t;
    if (!begin(&t, e, "economy-frames",
               "scene everything_ms planned_ms skipped_share everything_draws planned_draws everything_programs "
               "planned_programs everything_first_ms planned_first_ms everything_mib planned_mib",
               fault))
        return false;
    for (int i = 0; i < e->whole_count; i++) {
        const economy_whole *w = &e->wholes[i];
        table_text(&t, w->name);
        TABLE_END_ROW(&t, w->ms[0], w->ms[1], w->skipped, w->draws[0], w->draws[1], w->programs[0], w->programs[1],
                      w->first_ms[0], w->first_ms[1], mib(w->bytes[0]), mib(w->bytes[1]));
    }
    return table_end(&t, fault);
}

static bool write_steps(const economy *e, failure *fault)
{
    table t;
    if (!begin(&t, e, "economy-steps", "effect every_ms planned_ms occlusion_draws", fault))
        return false;
    for (int i = 0; i < ECONOMY_STEPS; i++) {
        table_text(&t, e->steps[i].what);
        TABLE_END_ROW(&t, e->steps[i].ms[0], e->steps[i].ms[1], e->steps[i].draws);
    }
    return table_end(&t, fault);
}

static bool write_shares(const economy *e, failure *fault)
{
    table t;
    if (!begin(&t, e, "economy-shares", "kind share every_ms skipping_ms skipped_share", fault))
        return false;
    for (int kind = 0; kind < 2; kind++)
        for (int i = 0; i < ECONOMY_SHARES; i++) {
            const economy_row *r = &e->shares[kind][i];
            table_text(&t, kind == 0 ? "sky" : "plane");
            TABLE_END_ROW(&t, (double)i / (ECONOMY_SHARES - 1), r->ms[0], r->ms[1], r->skipped);
        }
    return table_end(&t, fault);
}

static bool write_firsts(const economy *e, failure *fault)
{
    table t;
    if (!begin(&t, e, "economy-first", "kept ms", fault))
        return false;
    for (int i = 0; i < ECONOMY_FIRSTS; i++) {
        table_text(&t, economy_first_name(i));
        TABLE_END_ROW(&t, e->first_ms[i]);
    }
    return table_end(&t, fault);
}

bool economy_write(const economy *e, failure *fault)
{
    return write_tiles(e, fault) && write_frames(e, fault) && write_steps(e, fault) && write_shares(e, fault) &&
           write_firsts(e, fault);
}
