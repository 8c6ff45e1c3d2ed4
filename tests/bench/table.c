/* SPDX-License-Identifier: MIT
 *
 * Writing the tables.
 */
#define _POSIX_C_SOURCE 200809L
#include "table.h"

#include <glssao/glssao.h>

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static void read_cpu(char out[128])
{
    snprintf(out, 128, "unknown");
    FILE *f = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (f && fgets(line, sizeof line, f)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon) {
            snprintf(out, 128, "%.120s", colon + 1 + strspn(colon + 1, " \t"));
            out[strcspn(out, "\n")] = '\0';
            break;
        }
    }
    if (f)
        fclose(f);
}

bool table_begin(table *t, const options *o, const context *c, const char *name, const char *columns, failure *fault)
{
    const uint32_t v = glssao_version();
    char cpu[128];
    read_cpu(cpu);
    *t = (table){.file = NULL};
    snprintf(t->path, sizeof t->path, "%s/%s.tsv", o->out, name);
    t->file = fopen(t->path, "w");
    if (!t->file)
        return fault_set(fault, "%s: %s", t->path, strerror(errno));
    fprintf(t->file, "# %s\n", o->command);
    fprintf(t->file, "# glssao=%u.%u.%u\tcpu=%s\tcores=%ld\tcontext=%s\tsoftware=%d\t", v >> 16, v >> 8 & 255, v & 255,
            cpu, sysconf(_SC_NPROCESSORS_ONLN), context_description(c), context_is_software(c));
    fprintf(t->file, "size=%dx%d\trays=%d\ttime_size=%dx%d\tframes=%d\ttime_scene=%s\n", o->size[0], o->size[1],
            o->rays, o->time_size[0], o->time_size[1], o->frames, o->time_scene);
    for (; *columns; columns++)
        fputc(*columns == ' ' ? '\t' : *columns, t->file);
    fputc('\n', t->file);
    return true;
}

static void begin_cell(table *t)
{
    if (t->row_begun)
        fputc('\t', t->file);
    t->row_begun = true;
}

void table_text(table *t, const char *value)
{
    begin_cell(t);
    fputs(value, t->file);
}

void table_number(table *t, double value)
{
    begin_cell(t);
    if (isfinite(value))
        fprintf(t->file, "%.6g", value);
}

void table_end_row(table *t)
{
    fputc('\n', t->file);
    t->row_begun = false;
}

void table_numbers(table *t, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        table_number(t, values[i]);
}

bool table_end(table *t, failure *fault)
{
    const bool written = !ferror(t->file);
    if (fclose(t->file) == 0 && written)
        return true;
    return fault_set(fault, "%s: it could not be written in full", t->path);
}
