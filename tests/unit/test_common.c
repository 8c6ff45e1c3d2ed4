/* SPDX-License-Identifier: MIT
 *
 * The small jobs that the programs share.
 */
#define _POSIX_C_SOURCE 200809L /* mkfifo, fileno */
#include "error_color.h"
#include "fault.h"
#include "heap.h"
#include "inputs.h"
#include "matrix.h"
#include "read_file.h"
#include "statistics.h"
#include "testing.h"
#include "whole_file.h"
#include "words.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static const char path[] = "test_common.tmp";

static int remove_file(void **state)
{
    (void)state;
    remove(path);
    return 0;
}

static void write_file(const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

TEST(words_are_found_whole)
{
    assert_int_equal(words_find("low|medium|high", "low"), 0);
    assert_int_equal(words_find("low|medium|high", "high"), 2);
    assert_int_equal(words_find("low|medium|high", "med"), -1);
    assert_int_equal(words_find("low|medium|high", ""), -1);
    assert_int_equal(words_find("low|medium|high", "low|medium"), -1);
    assert_int_equal(words_find_span("off|on", "on,x", 2), 1);
    assert_string_equal(words_at(QUALITY_WORDS, 0).text, "low");
    assert_string_equal(words_at(QUALITY_WORDS, 3).text, "ultra");
}

TEST(percentile_is_the_nearest_rank)
{
    double values[] = {5, 1, 4, 2, 3}, one[] = {7}, even[] = {4, 1, 3, 2};
    assert_true(statistics_percentile(values, 5, 50) == 3);
    assert_true(statistics_percentile(values, 5, 95) == 5);
    assert_true(statistics_percentile(one, 1, 50) == 7);
    assert_true(statistics_percentile(even, 4, 50) == 2);
}

TEST(normals_stay_across_surfaces)
{
    /* Scales x by 2 and mirrors z: a plane's normal (1, 1, 0) becomes (1, 2, 0). */
    const float m[16] = {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 9, 9, 9, 1}, flat[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0};
    double n[9];
    assert_true(matrix_for_normals(m, n));
    assert_true(n[0] + n[3] == 0.5 && n[1] + n[4] == 1 && n[2] + n[5] == 0 && n[8] == -1);
    assert_false(matrix_for_normals(flat, n)); /* has no inverse; its plane's normal is z */
    assert_true(n[8] == 1 && n[0] == 0 && n[4] == 0);
}

TEST_WITH(regular_files_alone_are_read, remove_file)
{
    const char *reason;
    size_t size = 0;
    write_file("hello");
    SCOPED(memory) uint8_t *data = read_file(path, 5, &size, &reason);
    assert_non_null(data);
    assert_int_equal(size, 5);
    assert_string_equal((char *)data, "hello");
    assert_null(read_file(path, 4, &size, &reason));
    assert_string_equal(reason, "too large");
    assert_null(read_file(".", 100, &size, &reason));
    assert_string_equal(reason, "not a regular file");
    assert_null(read_file("no-such-file", 100, &size, &reason));
    assert_non_null(strstr(reason, "No such file"));
    remove(path);
    assert_int_equal(mkfifo(path, 0600), 0); /* opening it would wait for someone who writes */
    assert_null(read_file(path, 100, &size, &reason));
    assert_string_equal(reason, "not a regular file");
}

TEST(streams_are_read_to_their_end)
{
    const char *reason;
    size_t size = 0;
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], "abc", 3), 3);
    close(ends[1]);
    SCOPED(memory) uint8_t *data = read_stream(ends[0], 100, &size, &reason);
    close(ends[0]);
    assert_non_null(data);
    assert_int_equal(size, 3);
    assert_string_equal((char *)data, "abc");
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], "abc", 3), 3);
    close(ends[1]);
    assert_null(read_stream(ends[0], 2, &size, &reason));
    close(ends[0]);
    assert_string_equal(reason, "too large");
}

TEST_WITH(inputs_are_known_by_any_name, remove_file)
{
    const char *reason;
    size_t size;
    char error[256] = "";
    inputs in = {0};
    write_file("x");
    inputs_record(&in);
    free(read_file(path, 100, &size, &reason));
    inputs_record(NULL);
    free(read_file("/proc/self/exe", SIZE_MAX / 2, &size, &reason)); /* no longer recorded */
    assert_int_equal(in.count, 1);
    remove("test_common.link");
    assert_int_equal(symlink(path, "test_common.link"), 0);
    assert_false(inputs_spare(&in, NULL, path, FAULT(error)));
    assert_non_null(strstr(error, path));
    assert_false(inputs_spare(&in, NULL, "./test_common.tmp", FAULT(error)));
    assert_false(inputs_spare(&in, NULL, "test_common.link", FAULT(error)));
    assert_true(inputs_spare(&in, NULL, "test_common.other", FAULT(error)));
    assert_true(inputs_spare(&in, NULL, "/dev/null", FAULT(error)));
    inputs_forget(&in, "test_common.link");
    assert_true(inputs_spare(&in, NULL, path, FAULT(error)));
    assert_false(inputs_spare(&in, "test_common.link", path, FAULT(error)));
    inputs_free(&in);
    remove("test_common.link");
}

TEST(faults_are_one_line_and_the_first_stays)
{
    char error[32];
    failure f = {.file = "a.b", .text = error, .size = sizeof error};
    assert_false(fault_set(&f, "two\nlines\t\tand\001 more."));
    assert_string_equal(error, "a.b: two lines and? more");
    fault_set(&f, "later");
    assert_string_equal(error, "a.b: two lines and? more");
    fault_set(FAULT(error), "%s", "a text that is longer than what there is room for");
    assert_int_equal(strlen(error), 31);
}

TEST_WITH(abandoned_files_are_gone, remove_file)
{
    char error[256];
    whole_file file;
    write_file("old");
    assert_true(whole_file_open(&file, path, FAULT(error)));
    SCOPED(memory) char *temporary = file.temporary; /* stays: a signal handler may still read it */
    assert_int_equal(access(temporary, F_OK), 0);
    whole_file_abandon_all();
    assert_int_not_equal(access(temporary, F_OK), 0);
    assert_false(whole_file_close(&file, true, FAULT(error)));
    assert_int_equal(access(path, F_OK), 0);
}

TEST(errors_have_their_colours)
{
    double rgb[3];
    error_color(-0.2, 0.5, rgb); /* too dark */
    assert_true(rgb[2] > rgb[0] + 0.2 && rgb[2] > rgb[1] + 0.1);
    error_color(0.2, 0.5, rgb); /* too bright */
    assert_true(rgb[0] > rgb[1] + 0.2 && rgb[1] > rgb[2]);
    error_color(0, 0.5, rgb);
    assert_true(rgb[0] == rgb[1] && rgb[1] == rgb[2] && rgb[0] > 0.9);
}

/* Page faults of filling a new block as large as a software rasteriser's batches, and freeing it. Sanitizers bring an
 * allocator of their own. */
static long count_faults(void)
{
    enum { SIZE = 4 << 20 };
    struct rusage before, after;
    getrusage(RUSAGE_SELF, &before);
    unsigned char *block = malloc(SIZE);
    assert_non_null(block);
    memset(block, 1, SIZE);
    assert_int_equal(block[SIZE / 2], 1); /* else compilers drop the block */
    free(block);
    getrusage(RUSAGE_SELF, &after);
    return after.ru_minflt - before.ru_minflt;
}

TEST(freed_memory_is_kept)
{
    heap_keep_freed();
    (void)count_faults();
    const long faults = count_faults();
#if defined __GLIBC__ && !defined __SANITIZE_ADDRESS__
    assert_in_range(faults, 0, 16);
#else
    (void)faults;
    skip();
#endif
}

TEST_MAIN("common", NULL, NULL)
