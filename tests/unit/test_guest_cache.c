/* SPDX-License-Identifier: MIT
 *
 * The folder of linked programs as somebody else would use it against the host: files and links laid in wait, files
 * and folders that others may write. Nothing of theirs is loaded and nothing outside the folder is written.
 */
#define _XOPEN_SOURCE 700 /* mkdtemp, mkfifo, symlink */
#include "guest.h"

#include "gl_counter.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_FILES = 32, PATH_SIZE = 512 };

typedef struct cache {
    guest g;
    char folder[64], outside[64]; /* the second holds what an attacker owns or aims at */
    int count;                    /* files of a run */
    char names[MOST_FILES][256];
} cache;

static gl_counts run(cache *c, const char *folder)
{
    glssao_config config = fixture_config(c->g.f, GUEST_W, GUEST_H);
    fixture_clear_log(c->g.f);
    gl_counter_start(fixture_load, c->g.f->context);
    config.load = gl_counter_load;
    config.program_cache = folder;
    SCOPED(effect) glssao_effect *effect = NULL;
    assert_int_equal(glssao_create(&config, &effect), GLSSAO_OK);
    const glssao_settings settings = glssao_default_settings(GLSSAO_HORIZON, GLSSAO_LOW);
    assert_int_equal(glssao_compute(effect, &c->g.frame, &settings), GLSSAO_OK);
    return gl_counter_take();
}

static void path_of(char out[PATH_SIZE], const char *folder, const char *name, const char *end)
{
    snprintf(out, PATH_SIZE, "%s/%s%s", folder, name, end);
}

static void list(cache *c)
{
    c->count = 0;
    DIR *d = opendir(c->folder);
    assert_non_null(d);
    for (struct dirent *entry; (entry = readdir(d));)
        if (entry->d_name[0] != '.') {
            assert_true(c->count < MOST_FILES);
            snprintf(c->names[c->count++], sizeof c->names[0], "%s", entry->d_name);
        }
    closedir(d);
}

static void empty_folder(const char *folder)
{
    DIR *d = opendir(folder);
    assert_non_null(d);
    for (struct dirent *entry; (entry = readdir(d));) {
        char path[PATH_SIZE];
        path_of(path, folder, entry->d_name, "");
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            assert_int_equal(remove(path), 0);
    }
    closedir(d);
}

/* A folder that one run has filled; false where the driver keeps no binaries or the loader hides them. */
static bool open_cache(cache *c, fixture *f)
{
    *c = (cache){.g = guest_open(f, GLSSAO_PATH_FRAGMENT),
                 .folder = "/tmp/glssao-cache-XXXXXX",
                 .outside = "/tmp/glssao-outside-XXXXXX"};
    assert_non_null(mkdtemp(c->folder));
    assert_non_null(mkdtemp(c->outside));
    GLint formats = 0;
    if (!fixture_hides_newer())
        gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    const gl_counts first = run(c, c->folder), second = run(c, c->folder);
    list(c);
    if (formats == 0) {
        print_message("no program binaries here: nothing is kept\n");
        assert_int_equal(c->count, 0);
        return false;
    }
    assert_true(c->count > 0 && first.programs == c->count && second.binaries == c->count && second.programs == 0);
    return true;
}

static void close_cache(cache *c)
{
    assert_int_equal(chmod(c->folder, 0700), 0);
    empty_folder(c->folder);
    empty_folder(c->outside);
    assert_int_equal(rmdir(c->folder), 0);
    assert_int_equal(rmdir(c->outside), 0);
    guest_close(&c->g);
}

static void write_text(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_true(fputs(text, f) >= 0);
    assert_int_equal(fclose(f), 0);
}

static void check_text(const char *path, const char *text)
{
    char got[64] = "";
    FILE *f = fopen(path, "r");
    if (!f)
        fail_msg("%s is gone", path);
    (void)fgets(got, sizeof got, f);
    fclose(f);
    if (strcmp(got, text) != 0)
        fail_msg("%s was written to", path);
}

/* The names that a run would write under are known in advance: the final one, and any made of it by a fixed rule. */
TEST_GL(links_that_lie_in_wait_are_not_written_through)
{
    static const char *const ends[] = {"", ".part", ".tmp", "~"};
    cache c;
    if (open_cache(&c, f))
        for (size_t e = 0; e < sizeof ends / sizeof *ends; ++e) {
            char victim[PATH_SIZE];
            path_of(victim, c.outside, "victim", "");
            write_text(victim, "precious");
            empty_folder(c.folder);
            for (int i = 0; i < c.count; ++i) {
                char link[PATH_SIZE];
                path_of(link, c.folder, c.names[i], ends[e]);
                assert_int_equal(symlink(victim, link), 0);
            }
            (void)run(&c, c.folder);
            check_text(victim, "precious");
        }
    close_cache(&c);
}

/* A file of that name belongs to somebody: it is not emptied, whatever its name ends in. */
TEST_GL(files_that_lie_in_wait_are_not_written_to)
{
    cache c;
    if (open_cache(&c, f)) {
        empty_folder(c.folder);
        char path[PATH_SIZE];
        for (int i = 0; i < c.count; ++i) {
            path_of(path, c.folder, c.names[i], ".part");
            write_text(path, "another run");
        }
        (void)run(&c, c.folder);
        for (int i = 0; i < c.count; ++i) {
            path_of(path, c.folder, c.names[i], ".part");
            check_text(path, "another run");
        }
    }
    close_cache(&c);
}

/* The programs are good ones, but lie where anyone may have put them. */
TEST_GL(links_are_not_read_through)
{
    cache c;
    if (open_cache(&c, f)) {
        for (int i = 0; i < c.count; ++i) {
            char inside[PATH_SIZE], outside[PATH_SIZE];
            path_of(inside, c.folder, c.names[i], "");
            path_of(outside, c.outside, c.names[i], "");
            assert_int_equal(rename(inside, outside), 0);
            assert_int_equal(symlink(outside, inside), 0);
        }
        const gl_counts counts = run(&c, c.folder);
        if (counts.binaries != 0)
            fail_msg("%d programs were loaded through symbolic links", counts.binaries);
        assert_int_equal(counts.programs, c.count);
    }
    close_cache(&c);
}

/* Opening a pipe would wait for a writer for ever. */
TEST_GL(pipes_are_not_opened)
{
    cache c;
    if (open_cache(&c, f)) {
        empty_folder(c.folder);
        for (int i = 0; i < c.count; ++i) {
            char path[PATH_SIZE];
            path_of(path, c.folder, c.names[i], "");
            assert_int_equal(mkfifo(path, 0600), 0);
        }
        (void)alarm(30); /* kills the test if it waits */
        const gl_counts counts = run(&c, c.folder);
        (void)alarm(0);
        assert_true(counts.binaries == 0 && counts.programs == c.count);
    }
    close_cache(&c);
}

TEST_GL(files_that_others_may_write_are_not_read)
{
    static const mode_t modes[] = {0620, 0602, 0666};
    cache c;
    if (open_cache(&c, f))
        for (size_t m = 0; m < sizeof modes / sizeof *modes; ++m) {
            for (int i = 0; i < c.count; ++i) {
                char path[PATH_SIZE];
                path_of(path, c.folder, c.names[i], "");
                assert_int_equal(chmod(path, modes[m]), 0);
            }
            const gl_counts counts = run(&c, c.folder);
            if (counts.binaries != 0)
                fail_msg("%d programs were loaded from files of mode %o", counts.binaries, (unsigned)modes[m]);
            const gl_counts again = run(&c, c.folder); /* replaced by files of our own */
            assert_int_equal(again.binaries, c.count);
        }
    close_cache(&c);
}

TEST_GL(files_are_written_for_the_owner_alone_to_change)
{
    cache c;
    if (open_cache(&c, f)) {
        empty_folder(c.folder);
        const mode_t before = umask(0);
        (void)run(&c, c.folder);
        (void)umask(before);
        list(&c);
        assert_true(c.count > 0);
        for (int i = 0; i < c.count; ++i) {
            char path[PATH_SIZE];
            struct stat s;
            path_of(path, c.folder, c.names[i], "");
            assert_int_equal(lstat(path, &s), 0);
            if (s.st_mode & 022)
                fail_msg("%s has mode %o", c.names[i], (unsigned)(s.st_mode & 0777));
        }
    }
    close_cache(&c);
}

/* In a folder that others may write, any file may be theirs, sticky bit or not. */
TEST_GL(a_folder_that_others_may_write_is_not_used)
{
    static const mode_t modes[] = {0777, 01777, 0770};
    cache c;
    if (open_cache(&c, f))
        for (size_t m = 0; m < sizeof modes / sizeof *modes; ++m) {
            assert_int_equal(chmod(c.folder, modes[m]), 0);
            const gl_counts counts = run(&c, c.folder);
            if (counts.binaries != 0)
                fail_msg("%d programs were loaded from a folder of mode %o", counts.binaries, (unsigned)modes[m]);
            assert_non_null(strstr(c.g.f->log, "program_cache"));
            assert_ptr_equal(strchr(c.g.f->log, '\n') + 1, strchr(c.g.f->log, '\0')); /* one line */
        }
    close_cache(&c);
}

/* Only a test that runs as root can give files away. */
TEST_GL(what_another_user_owns_is_not_used)
{
    enum { ANOTHER = 65534 };
    cache c;
    if (open_cache(&c, f) && geteuid() == 0) {
        char path[PATH_SIZE];
        for (int i = 0; i < c.count; ++i) {
            path_of(path, c.folder, c.names[i], "");
            assert_int_equal(chown(path, ANOTHER, ANOTHER), 0);
        }
        const gl_counts files = run(&c, c.folder);
        if (files.binaries != 0)
            fail_msg("%d programs of another user were loaded", files.binaries);
        (void)run(&c, c.folder);
        assert_int_equal(chown(c.folder, ANOTHER, ANOTHER), 0);
        const gl_counts folder = run(&c, c.folder);
        assert_int_equal(chown(c.folder, geteuid(), getegid()), 0);
        if (folder.binaries != 0)
            fail_msg("%d programs were loaded from another user's folder", folder.binaries);
    }
    close_cache(&c);
}

TEST_MAIN(NULL, fixture_setup, fixture_teardown)
