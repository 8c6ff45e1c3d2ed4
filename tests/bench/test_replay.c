/* SPDX-License-Identifier: MIT
 *
 * Recordings of peers: the passes are drawn in order, and errors name the fault.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "peers.h"
#include "replay.h"

#include "fixture.h"

#include <unistd.h>

enum { WIDTH = 8, HEIGHT = 4 };

static char folder[] = "/tmp/glssao-replay-XXXXXX";
static char error[1024];

static void write_file(const char *name, const void *data, size_t size)
{
    char path[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(data, 1, size, f), size);
    assert_int_equal(fclose(f), 0);
}

static void write_text(const char *name, const char *text)
{
    write_file(name, text, strlen(text));
}

/* A pass writes a wave of the texture's left texel; a second one halves it and adds a number. */
static const char recording[] = "texture 2 1 r8 0 1 a.raw\n"
                                "texture 8 4 rgba16f 0 0 -\n"
                                "texture 8 4 r32f 0 0 -\n"
                                "program a.vert first.frag\n"
                                "program a.vert second.frag\n"
                                "clear 1 0 0 0 0\n"
                                "pass 0 0 0 4 4 1\n"
                                "sampler u_from 0\n"
                                "uniform u_parts 0.25 0.5\n"
                                "pass 1 0 0 8 4 2\n"
                                "sampler u_from 1\n"
                                "sampler u_white white\n"
                                "uniform u_unknown 1\n"
                                "uniform u_add 0.125\n"
                                "output 2\n";

static int make_folder_of_files(void **state)
{
    static const unsigned char texels[2] = {255, 0};
    assert_non_null(mkdtemp(folder));
    write_file("a.raw", texels, sizeof texels);
    write_file("short.raw", texels, 1);
    write_text("a.vert", "#version 330\nin vec3 position;\nin vec2 uv;\nout vec2 v_uv;\n"
                         "void main() { v_uv = uv; gl_Position = vec4(position, 1.0); }\n");
    write_text("first.frag",
               "#version 330\nuniform sampler2D u_from;\nuniform float u_parts[2];\nin vec2 v_uv;\nout vec4 o;\n"
               "void main() { o = vec4(texture(u_from, vec2(0.25, 0.5)).r * (u_parts[0] + u_parts[1])); }\n");
    write_text("second.frag",
               "#version 330\nuniform sampler2D u_from, u_white;\nuniform float u_add;\nin vec2 v_uv;\nout vec4 o;\n"
               "void main() { o = 0.5 * texture(u_from, v_uv) * texture(u_white, v_uv) + u_add; }\n");
    write_text("bad.frag", "#version 330\nnonsense\n");
    return fixture_setup(state);
}

static int remove_folder(void **state)
{
    static const char *const names[] = {"a.raw",       "short.raw", "a.vert",  "first.frag",
                                        "second.frag", "bad.frag",  "key.peer"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[256];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        remove(path);
    }
    rmdir(folder);
    return fixture_teardown(state);
}

static replay *load(replayer *r, const char *text)
{
    write_text("key.peer", text);
    return replay_load(r, folder, "key", FAULT(error));
}

TEST_GL(passes_are_drawn_in_order)
{
    const float one[4] = {1, 1, 1, 1};
    float out[WIDTH * HEIGHT];
    replayer *r = replayer_create(f->context);
    replay *p = load(r, recording);
    if (!p)
        fail_msg("%s", error);
    replay_inputs in = {{0}};
    gl.GenTextures(1, &in.textures[REPLAY_WHITE]);
    gl.BindTexture(GL_TEXTURE_2D, in.textures[REPLAY_WHITE]);
    gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, 1, 1, 0, GL_RGBA, GL_FLOAT, one);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    replay_draw(r, p, &in);
    assert_true(replay_read(p, WIDTH, HEIGHT, out, FAULT(error)));
    for (int i = 0; i < WIDTH * HEIGHT; i++) /* the first pass covers the left half and clears the rest to 0 */
        assert_true(fabsf(out[i] - (i % WIDTH < 4 ? 0.5f * 0.75f + 0.125f : 0.125f)) < 1e-3f);
    assert_false(replay_read(p, WIDTH, WIDTH, out, FAULT(error)));
    assert_non_null(strstr(error, "8x4"));
    replay_inputs_destroy(&in);
    replay_destroy(p);
    replayer_destroy(r);
}

TEST_GL(wrong_recordings_are_named)
{
    static const struct {
        const char *text, *said;
    } wrong[] = {
        {"nonsense\n", "not understood: nonsense"},
        {"texture 2 1 rgb9 0 0 -\n", "not understood: texture 2 1 rgb9"},
        {"texture 0 1 r8 0 0 -\n", "not understood: texture 0 1"},
        {"texture 2 1 r8 0 0 short.raw\n", "1 bytes are too few for 2x1 texels of r8"},
        {"texture 2 1 r8 0 0 none.raw\n", "none.raw: No such file"},
        {"program a.vert bad.frag\n", "bad.frag: "},
        {"texture 2 1 r8 0 0 -\npass 0 0 0 1 1 0\n", "not understood: pass 0"},
        {"texture 2 1 r8 0 0 -\nprogram a.vert first.frag\npass 0 0 0 1 1 7\n", "not understood: pass 0 0 0 1 1 7"},
        {"output 3\n", "not understood: output 3"}};
    replayer *r = replayer_create(f->context);
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_null(load(r, wrong[i].text));
        if (!strstr(error, wrong[i].said))
            fail_msg("%s: it says \"%s\"", wrong[i].said, error);
    }
    replayer_destroy(r);
}

/* The name of the recording that a view wants, from the message that there is none. */
static void find_name(peer_bench *b, const peer_view *v, char name[64])
{
    assert_null(peers_load(b, 0, v, FAULT(error)));
    const char *slash = strrchr(error, '/');
    if (!slash || sscanf(slash + 1, "%63[^:]", name) != 1 || !strstr(name, ".peer"))
        fail_msg("%s", error);
}

TEST(other_machines_find_recordings)
{
    gbuffer g = {.view = {.width = WIDTH, .height = HEIGHT, .view_from_world = {1, 0, 0.123456789f}}}, other = g;
    peer_view v = {&g, 0.3f, 7}, w = {&other, nextafterf(0.3f, 1), 7.001f};
    peer_bench b = {.modules = NULL};
    char name[64], found[64], path[256];
    memcpy(b.folder, folder, sizeof folder);
    g.view.clip_from_view[10] = other.view.clip_from_view[10] = -1.1f;
    g.view.clip_from_view[14] = other.view.clip_from_view[14] = -0.2f;
    find_name(&b, &v, name);
    assert_false(peers_record(&b, (int[]){0}, 1, &v, 1, FAULT(error)));
    assert_non_null(strstr(error, "no recording of three-gtao at 8x4"));
    write_text(name, "");
    assert_true(peers_record(&b, (int[]){0}, 1, &v, 1, FAULT(error)));
    assert_true(peers_record(&b, (int[]){0}, 1, &w, 1, FAULT(error)));
    snprintf(path, sizeof path, "%s/%s", folder, name);
    remove(path);
    other.view.view_from_world[2] = nextafterf(0.123456789f, 1);
    find_name(&b, &w, found);
    assert_string_equal(name, found);
    w.radius = 0.301f;
    find_name(&b, &w, found);
    assert_string_not_equal(name, found);
    other.view.width++;
    w.radius = v.radius;
    find_name(&b, &w, found);
    assert_string_not_equal(name, found);
}

TEST_MAIN(NULL, make_folder_of_files, remove_folder)
