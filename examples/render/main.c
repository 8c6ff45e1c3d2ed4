/* SPDX-License-Identifier: MIT
 *
 * glssao-render: renders scenes to pictures without a display.
 */
#include "batch.h"
#include "clock.h"
#include "heap.h"
#include "job.h"
#include "stop.h"
#include "streams.h"

#include <stdio.h>

enum { EXIT_DONE = 0, EXIT_NOT_RENDERED = 1, EXIT_USAGE = 2, ERROR_LENGTH = 8192 };

int main(int argc, char **argv)
{
    const double start_ms = clock_wall_ms();
    static options o;
    static char error[ERROR_LENGTH], late[128];
    size_t pictures;
    streams_guard("glssao-render", EXIT_NOT_RENDERED);
    heap_keep_freed();
    switch (options_parse(argc, argv, &o, FAULT(error))) {
    case OPTIONS_DONE:
        return EXIT_DONE;
    case OPTIONS_WRONG:
        fprintf(stderr, "glssao-render: %s\n", error);
        return EXIT_USAGE;
    case OPTIONS_RUN:
        break;
    }
    if (o.batch) {
        const bool done = batch_run(&o);
        return stop_signal() ? 128 + stop_signal()
               : done        ? EXIT_DONE
                             : EXIT_NOT_RENDERED; /* the code that a shell gives a program ended by a signal */
    }
    stop_at_once();
    if (o.timeout_s.given) {
        snprintf(late, sizeof late, "glssao-render: --timeout %g: not done by then", (double)o.timeout_s.value);
        stop_after((double)o.timeout_s.value, late, EXIT_NOT_RENDERED);
    }
    const bool done = job_run(&o, false, start_ms, &pictures, FAULT(error));
    if (!done)
        fprintf(stderr, "glssao-render: %s\n", error);
    return done ? EXIT_DONE : EXIT_NOT_RENDERED;
}
