/* SPDX-License-Identifier: MIT
 *
 * What view.sh does to the viewer's window that xdotool can't.
 *   hands drop WINDOW FILE   drags a file from a window of its own onto that one (XDND, version 5)
 *   hands minimise WINDOW    as a window manager would: the state, and out of sight (ICCCM 4.1.4)
 *   hands restore WINDOW
 */
#define _POSIX_C_SOURCE 200809L
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { XDND_VERSION = 5, STEP_MS = 10, MOST_STEPS = 1000 };

static Atom atom(Display *display, const char *name)
{
    return XInternAtom(display, name, False);
}

static void tell(Display *display, Window to, const char *what, const long data[5])
{
    XEvent event = {
        .xclient = {.type = ClientMessage, .window = to, .message_type = atom(display, what), .format = 32}};
    memcpy(event.xclient.data.l, data, 5 * sizeof *data);
    XSendEvent(display, to, False, NoEventMask, &event);
    XFlush(display);
}

/* file:///..., with all but plain characters as %XX. */
static void write_uri(const char *path, char *out, size_t size)
{
    size_t used = (size_t)snprintf(out, size, "file://");
    for (const char *c = path; *c && used + 6 < size; c++) {
        const bool plain = strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/", *c);
        used += (size_t)snprintf(out + used, size - used, plain ? "%c" : "%%%02X", (unsigned char)*c);
    }
    snprintf(out + used, size - used, "\r\n");
}

static void hand_over(Display *display, const XSelectionRequestEvent *asked, const char *uri)
{
    XEvent answer = {.xselection = {.type = SelectionNotify,
                                    .requestor = asked->requestor,
                                    .selection = asked->selection,
                                    .target = asked->target,
                                    .time = asked->time}};
    if (asked->target == atom(display, "text/uri-list")) {
        XChangeProperty(display, asked->requestor, asked->property, asked->target, 8, PropModeReplace,
                        (const unsigned char *)uri, (int)strlen(uri));
        answer.xselection.property = asked->property;
    }
    XSendEvent(display, asked->requestor, False, NoEventMask, &answer);
    XFlush(display);
}

/* Serves the dropped data until that message comes. */
static bool wait_for(Display *display, const char *message, const char *uri, XClientMessageEvent *out)
{
    for (int i = 0; i < MOST_STEPS; i++) {
        while (XPending(display)) {
            XEvent event;
            XNextEvent(display, &event);
            if (event.type == SelectionRequest)
                hand_over(display, &event.xselectionrequest, uri);
            if (event.type == ClientMessage && event.xclient.message_type == atom(display, message)) {
                *out = event.xclient;
                return true;
            }
        }
        nanosleep(&(struct timespec){0, STEP_MS * 1000000}, NULL);
    }
    fprintf(stderr, "no %s\n", message);
    return false;
}

static bool drop(Display *display, Window to, const char *path)
{
    char uri[4096];
    XClientMessageEvent answer;
    int x = 0, y = 0;
    Window child;
    write_uri(path, uri, sizeof uri);
    const Window source = XCreateSimpleWindow(display, DefaultRootWindow(display), 0, 0, 1, 1, 0, 0, 0);
    const Atom selection = atom(display, "XdndSelection");
    XSetSelectionOwner(display, selection, source, CurrentTime);
    XTranslateCoordinates(display, to, DefaultRootWindow(display), 100, 100, &x, &y, &child);
    tell(display, to, "XdndEnter",
         (long[5]){(long)source, (long)XDND_VERSION << 24, (long)atom(display, "text/uri-list")});
    tell(display, to, "XdndPosition",
         (long[5]){(long)source, 0, (long)x << 16 | y, CurrentTime, (long)atom(display, "XdndActionCopy")});
    if (!wait_for(display, "XdndStatus", uri, &answer) || !(answer.data.l[1] & 1))
        return false;
    tell(display, to, "XdndDrop", (long[5]){(long)source, 0, CurrentTime});
    return wait_for(display, "XdndFinished", uri, &answer) && answer.data.l[1]; /* GLFW 3.3: how many bytes it took */
}

static bool set_state(Display *display, Window window, long state)
{
    const long value[2] = {state, None};
    const Atom name = atom(display, "WM_STATE");
    XChangeProperty(display, window, name, name, 32, PropModeReplace, (const unsigned char *)value, 2);
    if (state == IconicState)
        XUnmapWindow(display, window);
    else
        XMapWindow(display, window);
    XSync(display, False);
    return true;
}

int main(int argc, char **argv)
{
    Display *display = argc >= 3 ? XOpenDisplay(NULL) : NULL;
    if (!display)
        return 2;
    const Window window = strtoul(argv[2], NULL, 0);
    bool done = false;
    if (argc == 4 && !strcmp(argv[1], "drop"))
        done = drop(display, window, argv[3]);
    else if (argc == 3 && !strcmp(argv[1], "minimise"))
        done = set_state(display, window, IconicState);
    else if (argc == 3 && !strcmp(argv[1], "restore"))
        done = set_state(display, window, NormalState);
    XCloseDisplay(display);
    return done ? 0 : 1;
}
