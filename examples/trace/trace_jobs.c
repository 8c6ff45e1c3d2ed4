/* SPDX-License-Identifier: MIT
 *
 * Threads that take jobs from one counter until none is left. The caller's thread works too, and reports progress
 * between its own jobs.
 */
#define _POSIX_C_SOURCE 200809L
#include "trace_internal.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

enum { MOST_THREADS = 256 };

typedef struct queue {
    atomic_size_t next, done;
    size_t count;
    void (*work)(size_t job, void *user);
    void *user;
} queue;

static bool take_job(queue *q)
{
    const size_t job = atomic_fetch_add(&q->next, 1);
    if (job >= q->count)
        return false;
    q->work(job, q->user);
    atomic_fetch_add(&q->done, 1);
    return true;
}

static void *run_thread(void *argument)
{
    while (take_job(argument)) {
    }
    return NULL;
}

void trace_run_jobs(int threads, size_t count, void (*work)(size_t job, void *user), void *user,
                    trace_progress_fn progress, void *progress_user)
{
    queue q = {.count = count, .work = work, .user = user};
    if (threads < 1)
        threads = (int)sysconf(_SC_NPROCESSORS_ONLN);
    pthread_t others[MOST_THREADS];
    int started = 0;
    while (started + 1 < threads && started < MOST_THREADS &&
           pthread_create(&others[started], NULL, run_thread, &q) == 0) {
        started++;
    }
    while (take_job(&q)) {
        if (progress)
            progress((double)atomic_load(&q.done) / (double)count, progress_user);
    }
    for (int i = 0; i < started; i++)
        pthread_join(others[i], NULL);
    if (progress)
        progress(1, progress_user);
}
