/* alone FILE.csv FOLDER SHARDS: a folder of shards by one process without MPI, which those of several have to equal. */
#include <froe/arrays.h>
#include <froe/formats.h>
#include <froe/shards.h>
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    froe_scene_arrays a = {0};
    froe_shards_builder *builder = NULL;
    froe_shards_options o = froe_shards_defaults();
    froe_objects batch = froe_objects_defaults();
    if (argc != 4) return 2;
    o.shards = (uint32_t)atoi(argv[3]);
    if (froe_read_own(argv[1], NULL, &scene, NULL, &diag) || froe_arrays_of_scene(scene, NULL, &a, &diag) ||
        froe_shards_begin(argv[2], a.dim, &o, &builder, &diag))
        return fprintf(stderr, "alone: %s\n", diag.message), 1;
    batch.kind = (froe_kind)a.kinds[0];
    batch.count = a.object_count, batch.point_count = a.vertex_count;
    batch.coords = a.coords, batch.indices = a.corners, batch.tags = a.tags;
    batch.starts = batch.kind == FROE_HULL ? a.starts : NULL;
    batch.radii = batch.kind == FROE_BALL ? a.radii : NULL;
    const froe_status status = froe_shards_add(builder, &batch, &diag);
    if (status) froe_shards_abandon(builder);
    if (status || froe_shards_finish(builder, NULL, &diag)) return fprintf(stderr, "alone: %s\n", diag.message), 1;
    froe_scene_arrays_free(&a), froe_scene_free(scene);
    return 0;
}
