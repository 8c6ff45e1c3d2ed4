/* SPDX-License-Identifier: MIT
 *
 * Programs kept on disk: loaded where they fit, silently recompiled where they do not.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "analytic.h"
#include "fixture.h"
#include "gl_counter.h"

#include <dirent.h>
#include <unistd.h>

enum { W = 64, H = 48, PROGRAMS = 7 /* apply, and horizon's six */ };

typedef struct cached {
    fixture *f;
    char folder[64];
    glssao_frame frame;
    float *wanted;   /* the picture from compiled programs */
    bool is_refused; /* the log says that the folder is not used */
} cached;

typedef void (*file_fn)(const char *path);

static int for_each_file(const char *folder, file_fn change)
{
    int count = 0;
    DIR *d = opendir(folder);
    assert_non_null(d);
    for (struct dirent *entry; (entry = readdir(d));) {
        char path[512];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        assert_non_null(strstr(entry->d_name, ".bin"));
        assert_null(strstr(entry->d_name, ".part"));
        if (change)
            change(path);
        count++;
    }
    closedir(d);
    return count;
}

static void delete_file(const char *path)
{
    remove(path);
}

/* One effect and one frame; the picture must be the same. */
static gl_counts run_path(cached *c, const char *folder, glssao_path path)
{
    fixture_clear_log(c->f);
    glssao_config config = fixture_config(c->f, W, H);
    gl_counter_start(fixture_load, c->f->context);
    config.load = gl_counter_load;
    config.program_cache = folder;
    config.path = path;
    glssao_effect *effect = NULL;
    assert_int_equal(glssao_create(&config, &effect), GLSSAO_OK);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_MEDIUM);
    int w, h;
    float *got = fixture_compute(effect, &c->frame, &settings, &w, &h);
    if (c->wanted) {
        for (int i = 0; i < w * h; ++i)
            assert_float_equal(got[i], c->wanted[i], path == GLSSAO_PATH_COMPUTE ? 1.6e-5f : 0.0f);
        free(got);
    } else {
        c->wanted = got;
    }
    glssao_destroy(effect);
    if (c->is_refused)
        assert_non_null(strstr(c->f->log, "config.program_cache"));
    else
        assert_string_equal(c->f->log, "");
    return gl_counter_take();
}

static gl_counts run(cached *c, const char *folder)
{
    return run_path(c, folder, GLSSAO_PATH_FRAGMENT);
}

static cached open_cached(fixture *f)
{
    cached c = {.f = f, .folder = "/tmp/glssao-cache-XXXXXX"};
    assert_non_null(mkdtemp(c.folder));
    c.frame = fixture_room(PERSPECTIVE, W, H);
    const gl_counts counts = run(&c, NULL);
    assert_true(counts.programs == PROGRAMS && counts.binaries == 0);
    return c;
}

static void close_cached(cached *c)
{
    for_each_file(c->folder, delete_file);
    rmdir(c->folder);
    fixture_delete_frame(&c->frame);
    free(c->wanted);
}

/* Fills the folder. Returns false, which ends the test, if the driver keeps no binaries or the loader hides them. */
static bool fill(cached *c)
{
    GLint formats = 0;
    if (!fixture_hides_newer())
        gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    const gl_counts counts = run(c, c->folder);
    assert_int_equal(counts.programs, PROGRAMS);
    assert_int_equal(for_each_file(c->folder, NULL), formats > 0 ? PROGRAMS : 0);
    if (formats == 0)
        print_message("no program binaries here: nothing is kept\n");
    return formats > 0;
}

TEST_GL(the_second_run_compiles_nothing)
{
    cached c = open_cached(f);
    if (fill(&c)) {
        const gl_counts counts = run(&c, c.folder);
        assert_true(counts.programs == 0 && counts.shaders == 0 && counts.binaries == PROGRAMS);
    }
    close_cached(&c);
}

/* Both ways draw the program of glssao_apply; the frame's three compute shaders are other programs than its four
 * fragment ones. */
TEST_GL(each_path_has_programs_of_its_own)
{
    cached c = open_cached(f);
    if (fill(&c))
        for (int i = 0; i < 2; ++i) {
            const gl_counts counts = run_path(&c, c.folder, GLSSAO_PATH_COMPUTE);
            assert_true(counts.programs == (i ? 0 : 3) && counts.binaries == (i ? 4 : 1));
            assert_int_equal(for_each_file(c.folder, NULL), PROGRAMS + 3);
        }
    close_cached(&c);
}

static void change_byte(const char *path, long at)
{
    FILE *f = fopen(path, "r+b");
    assert_non_null(f);
    assert_int_equal(fseek(f, at, at < 0 ? SEEK_END : SEEK_SET), 0);
    const int byte = fgetc(f);
    assert_int_equal(fseek(f, -1, SEEK_CUR), 0);
    fputc(byte ^ 0x5A, f);
    fclose(f);
}

static void change_magic(const char *path)
{
    change_byte(path, 0);
}

static void change_key(const char *path)
{
    change_byte(path, 9);
}

static void change_format(const char *path)
{
    change_byte(path, 24);
}

static void change_length(const char *path)
{
    change_byte(path, 31);
}

static void change_program(const char *path)
{
    change_byte(path, -20);
}

static void cut_short(const char *path)
{
    assert_int_equal(truncate(path, 100), 0);
}

static void empty(const char *path)
{
    assert_int_equal(truncate(path, 0), 0);
}

/* Each damaged file is refused, recompiled and repaired on disk. */
TEST_GL(damaged_files_are_compiled_anew)
{
    static const file_fn damages[] = {change_magic, change_key, change_length, change_program, cut_short, empty};
    cached c = open_cached(f);
    if (fill(&c))
        for (size_t i = 0; i < sizeof damages / sizeof *damages; ++i) {
            assert_int_equal(for_each_file(c.folder, damages[i]), PROGRAMS);
            const gl_counts counts = run(&c, c.folder);
            assert_true(counts.programs == PROGRAMS && counts.binaries == 0);
            const gl_counts mended = run(&c, c.folder);
            assert_true(mended.programs == 0 && mended.binaries == PROGRAMS);
        }
    close_cached(&c);
}

/* The checksum covers the head: the driver never gets a format that it did not write. */
TEST_GL(a_strange_format_is_not_handed_to_the_driver)
{
    cached c = open_cached(f);
    if (fill(&c)) {
        for_each_file(c.folder, change_format);
        const gl_counts counts = run(&c, c.folder);
        assert_true(counts.programs == PROGRAMS && counts.binaries == 0);
    }
    close_cached(&c);
}

TEST_GL(a_folder_that_is_not_there_does_no_harm)
{
    cached c = open_cached(f);
    c.is_refused = true;
    const gl_counts counts = run(&c, "/nowhere/at/all");
    assert_true(counts.programs == PROGRAMS && counts.binaries == 0);
    close_cached(&c);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
