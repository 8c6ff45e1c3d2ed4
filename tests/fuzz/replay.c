/* SPDX-License-Identifier: MIT
 *
 * replay [file|folder]...: gives each file, and each below the folders, to the fuzz target once; for compilers without
 * libFuzzer, and for CI. Large files are left to test_gltf_files. Exits 77 (skipped) where there is no file at all.
 */
#define _XOPEN_SOURCE 700 /* nftw */
#include <ftw.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { MOST_BYTES = 64 << 10 };

static int files;

static int visit(const char *path, const struct stat *about, int type, struct FTW *where)
{
    (void)where;
    if (type != FTW_F || about->st_size > MOST_BYTES)
        return 0;
    FILE *file = fopen(path, "rb");
    uint8_t *data = malloc((size_t)about->st_size + 1);
    if (!file || !data || fread(data, 1, (size_t)about->st_size, file) != (size_t)about->st_size) {
        fprintf(stderr, "%s: not read\n", path);
        exit(1);
    }
    fclose(file);
    LLVMFuzzerTestOneInput(data, (size_t)about->st_size);
    free(data);
    ++files;
    return 0;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i)
        (void)nftw(argv[i], visit, 16, FTW_PHYS); /* a folder that is not there has no files */
    printf("%d files\n", files);
    return files > 0 ? 0 : 77;
}
