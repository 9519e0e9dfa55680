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
    const size_t each = batch.kind == FROE_SEGMENT || batch.kind == FROE_BOX ? 2 : 1;
    uint32_t *corners = calloc(a.object_count * each + 1, sizeof *corners);
    if (!corners) return 4;
    for (size_t i = 0; i < a.object_count; i++) /* where an object has no length, its last corner is also the others */
        for (size_t c = 0, last = a.starts[i + 1] - a.starts[i] - 1; c < each; c++)
            corners[i * each + c] = a.corners[a.starts[i] + (c < last ? c : last)];
    batch.coords = a.coords, batch.tags = a.tags;
    batch.indices = batch.kind == FROE_HULL ? a.corners : corners;
    batch.starts = batch.kind == FROE_HULL ? a.starts : NULL;
    batch.radii = batch.kind == FROE_BALL ? a.radii : NULL;
    const froe_status status = froe_shards_add(builder, &batch, &diag);
    if (status) froe_shards_abandon(builder);
    if (status || froe_shards_finish(builder, NULL, &diag)) return fprintf(stderr, "alone: %s\n", diag.message), 1;
    free(corners), froe_scene_arrays_free(&a), froe_scene_free(scene);
    return 0;
}
