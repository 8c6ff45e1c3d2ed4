/* SPDX-License-Identifier: MIT */
#include "tool.h"

#include "gl.h"
#include "truth.h"

#include <stdio.h>

enum { EXIT_DONE = 0, EXIT_FAILED = 1, EXIT_USAGE = 2 };

int tool_begin(const char *name, int argc, char **argv, options *out)
{
    char error[4096] = "";
    const options_result parsed = options_parse(argc, argv, out, FAULT(error));
    if (parsed == OPTIONS_WRONG)
        fprintf(stderr, "%s: %s\n", name, error);
    return parsed == OPTIONS_RUN ? -1 : parsed == OPTIONS_WRONG ? EXIT_USAGE : EXIT_DONE;
}

context *tool_open(const options *o, failure *fault)
{
    if (!make_folder(o->out)) {
        fault_set(fault, "%s: no such folder can be made", o->out);
        return NULL;
    }
    context *c = context_create(&(context_options){.kind = (context_kind)o->context}, fault->text, fault->size);
    if (!c || !gl_load(context_load, c, fault->text, fault->size)) {
        context_destroy(c);
        return NULL;
    }
    fprintf(stderr, "context: %s\n", context_description(c));
    return c;
}

int tool_end(const char *name, bool done, const char *error)
{
    if (!done)
        fprintf(stderr, "%s: %s\n", name, error);
    return done ? EXIT_DONE : EXIT_FAILED;
}
