/* SPDX-License-Identifier: MIT
 *
 * The child writes its result to a pipe. The pipe closes when the child ends, however it ends.
 */
#define _XOPEN_SOURCE 700
#include "batch_isolated.h"

#include "clock.h"
#include "job.h"
#include "outputs.h"
#include "stop.h"
#include "whole_file.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct result {
    bool done;
    size_t pictures;
    char error[8192];
} result;

static void work(const options *o, bool quiet, int to)
{
    static result r;
    stop_at_once();
    r.done = job_run(o, quiet, clock_wall_ms(), &r.pictures, FAULT(r.error));
    fflush(stdout);
    const char *at = (const char *)&r;
    for (size_t left = sizeof r; left;) {
        const ssize_t written = write(to, at, left);
        if (written < 0 && errno != EINTR)
            break;
        at += written > 0 ? written : 0;
        left -= written > 0 ? (size_t)written : 0;
    }
    _exit(0);
}

/* Returns how many bytes of the result arrived: sizeof(result) if all did. `until_ms` 0: waits without limit. */
static size_t wait_for_result(int from, double until_ms, result *out)
{
    size_t size = 0;
    while (size < sizeof *out && !stop_signal()) {
        const double left_ms = until_ms - clock_wall_ms();
        if (until_ms > 0 && left_ms <= 0)
            break;
        /* Wakes ten times a second: a signal that arrives just before poll does not interrupt it. */
        const int wait_ms = until_ms > 0 && left_ms < 100 ? (int)left_ms + 1 : 100;
        struct pollfd p = {.fd = from, .events = POLLIN};
        if (poll(&p, 1, wait_ms) <= 0)
            continue;
        const ssize_t got = read(from, (char *)out + size, sizeof *out - size);
        if (got == 0)
            break;
        size += got > 0 ? (size_t)got : 0;
    }
    return size;
}

static bool remove_left(const char *path, void *user)
{
    whole_file_remove_left(path, *(const long *)user);
    return true;
}

/* Kills the child if it still runs, and removes its half-written files. Returns its status. */
static int bury(const options *o, pid_t child)
{
    int status = 0;
    long process = child;
    kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    outputs_each(o, remove_left, &process);
    if (o->stats)
        remove_left(o->stats, &process);
    return status;
}

bool batch_run_isolated(const options *o, bool quiet, size_t *out_pictures, fault *why)
{
    static result r;
    int ends[2];
    *out_pictures = 0;
    if (pipe(ends) != 0)
        return fault_set(why, "no pipe to a process: %s", strerror(errno));
    fflush(NULL);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        work(o, quiet, ends[1]);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return fault_set(why, "no process for the job: %s", strerror(errno));
    }
    const double until_ms = o->timeout_s.given ? clock_wall_ms() + 1e3 * (double)o->timeout_s.value : 0;
    const bool whole = wait_for_result(ends[0], until_ms, &r) == sizeof r;
    const bool late = !whole && until_ms > 0 && clock_wall_ms() >= until_ms;
    close(ends[0]);
    if (whole) {
        waitpid(child, NULL, 0);
        *out_pictures = r.pictures;
        return r.done || fault_set(why, "%s", r.error);
    }
    const int status = bury(o, child);
    if (stop_signal())
        return fault_set(why, "stopped");
    if (late)
        return fault_set(why, "--timeout %g: not done by then", (double)o->timeout_s.value);
    if (WIFSIGNALED(status))
        return fault_set(why, "its process died: %s", strsignal(WTERMSIG(status)));
    return fault_set(why, "its process ended with code %d", WEXITSTATUS(status));
}
