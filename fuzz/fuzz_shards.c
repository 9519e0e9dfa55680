/* fuzz_shards.c: any text as the manifest of a folder of shards, with its right checksum behind it. What can be read
 * names shards that are not there. */
#include "shards/manifest.h"
#include "support.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char folder[256], path[300];
    froe_shards *shards;
    froe_diagnostic why;
    fuzz_file("", ".froes", data, size, folder, sizeof folder);
    remove(folder);
    if (mkdir(folder, 0700)) fuzz_complain("no folder can be made", NULL);
    snprintf(path, sizeof path, "%s/froe.shards", folder);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size ||
        fprintf(file, "end %016llx\n", (unsigned long long)shards_manifest_sum((const char *)data, size)) < 0 ||
        fclose(file))
        fuzz_complain("no manifest can be written", NULL);
    if (froe_shards_open(folder, NULL, &shards, &why) == FROE_OK) {
        const froe_shards_info info = froe_shards_about(shards);
        const froe_tree *tree = NULL;
        double points[2 * FROE_MAX_DIM] = {0};
        froe_finds finds;
        if (info.dim < 2 || info.dim > FROE_MAX_DIM || !info.shards || !info.copies) abort();
        for (uint32_t i = 0; i < info.shards; i++)
            if (froe_shards_tree(shards, i, &tree, &why) == FROE_OK && tree) abort();
        if (froe_shards_near(shards, points, 2, 3, (double)INFINITY, NULL, &finds, &why) == FROE_OK) abort();
        froe_shards_close(shards);
    } else if (!strstr(why.message, "froe.shards")) {
        fuzz_complain("the manifest is not named", &why);
    }
    remove(path);
    rmdir(folder);
    return 0;
}
