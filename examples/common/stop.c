/* SPDX-License-Identifier: MIT */
#define _XOPEN_SOURCE 700 /* setitimer */
#include "stop.h"

#include "whole_file.h"

#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

static volatile sig_atomic_t noted;
static const char *time_message;
static int time_code;

static void end(int number)
{
    whole_file_abandon_all();
    signal(number, SIG_DFL);
    raise(number);
}

static void note(int number)
{
    if (noted)
        end(number);
    noted = number;
}

static void on_time(int number)
{
    (void)number;
    whole_file_abandon_all();
    /* Nothing can be done about a message that does not get through. */
    if (write(STDERR_FILENO, time_message, strlen(time_message)) >= 0 && write(STDERR_FILENO, "\n", 1) >= 0)
        _exit(time_code);
    _exit(time_code);
}

/* `flags`: SA_NODEFER lets the signal that a handler raises again through. */
static void handle(int number, void (*handler)(int), int flags)
{
    struct sigaction action = {.sa_handler = handler, .sa_flags = flags};
    sigemptyset(&action.sa_mask);
    sigaction(number, &action, NULL);
}

void stop_at_once(void)
{
    handle(SIGINT, end, SA_NODEFER);
    handle(SIGTERM, end, SA_NODEFER);
}

void stop_when_asked(void)
{
    handle(SIGINT, note, SA_NODEFER); /* without SA_RESTART: waiting ends */
    handle(SIGTERM, note, SA_NODEFER);
}

int stop_signal(void)
{
    return noted;
}

void stop_after(double seconds, const char *message, int code)
{
    double whole;
    const double part = modf(seconds, &whole);
    const struct itimerval timer = {.it_value = {.tv_sec = (time_t)whole, .tv_usec = (suseconds_t)(part * 1e6)}};
    time_message = message;
    time_code = code;
    handle(SIGALRM, on_time, 0);
    setitimer(ITIMER_REAL, &timer, NULL);
}
