/* read_assimp.c: solid models in all formats of assimp, as they are in the
 * file: no post-processing step of assimp runs, for those that weld, drop or split do
 * so within tolerances. Its coordinates are single precision; node transforms are
 * multiplied out in double. Nodes are listed with an explicit stack. */
#include "assimp_metadata.h"
#include "assimp_nodes.h"
#include "assimp_paint.h"
#include "check/check.h"
#include "readers.h"
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* assimp keeps the text of the last failure in one variable for all threads: this
 * lock, the library's only global, is held from an import until its text is copied. */
static pthread_mutex_t import_lock = PTHREAD_MUTEX_INITIALIZER;

bool io_assimp_recognise(const formats_source *source) {
    /* what OGR reads too, and better, or what other programs mean by the extension */
    static const char *const left_to_ogr[] = {"dxf", "xml", "json", "csv", "txt", "prj", "raw", "gml", "kml", "svg"};
    if (!strncmp(source->head, "glTF", 4) || !strncmp(source->head, "ISO-10303-21", 12)) return true;
    if (!*source->extension.text) return false;
    for (size_t i = 0; i < sizeof left_to_ogr / sizeof *left_to_ogr; ++i)
        if (!strcmp(source->extension.text, left_to_ogr[i])) return false;
    char dotted[sizeof source->extension.text + 1] = ".";
    memcpy(dotted + 1, source->extension.text, sizeof source->extension.text);
    return aiIsExtensionSupported(dotted);
}

/* --------------------------------------------------------------- the walk -- */

/* What faces of a node with a material belong to: a group, or one for each colour. */
typedef struct material_group {
    unsigned material;
    uint32_t group;
    struct aiString name; /* of the material */
    formats_paint colours;
} material_group;

typedef struct model {
    const struct aiScene *scene;
    formats_sink *sink;
    io_nodes *nodes;
    ARRAY(double) points;         /* transformed vertices of a mesh, 3 each */
    ARRAY(double) corners;        /* of a face, 3 each */
    ARRAY(double) places;         /* of its texture, 2 each */
    ARRAY(material_group) groups; /* of the current node */
    ARRAY(assimp_paint) paints;   /* per material */
    formats_images images;
    uint64_t faces, faces_done;
    bool linear; /* colours are shares of light (glTF), not of sRGB */
} model;

static froe_status corrupt(model *w, const char *sentence) {
    return support_fail(w->sink->diag, FROE_E_FORMAT, "%s: %s", support_short(w->sink->path), sentence);
}

/* What the faces of a node with a material belong to. Each name of a material is one group, or with `boxes` each node.
 * */
static froe_status find_material(model *w, unsigned material, material_group **out) {
    for (size_t i = 0; i < w->groups.count; ++i)
        if (w->groups.data[i].material == material) return *out = w->groups.data + i, FROE_OK;
    material_group own = {.material = material, .group = FROE_NONE};
    if (material < w->scene->mNumMaterials)
        aiGetMaterialString(w->scene->mMaterials[material], AI_MATKEY_NAME, &own.name);
    for (size_t i = 0; i < w->groups.count; ++i)
        if (w->sink->boxes || !strcmp(w->groups.data[i].name.data, own.name.data)) own.group = w->groups.data[i].group;
    if (!array_push(&w->sink->alloc, &w->groups, own)) return support_fail_memory(w->sink->diag);
    *out = w->groups.data + w->groups.count - 1;
    return FROE_OK;
}

/* The group of faces that have no colour of their own becomes that of the objects to come. */
static froe_status enter_material(model *w, const struct aiNode *node, material_group *own) {
    w->sink->group = own->group;
    if (own->group != FROE_NONE) return FROE_OK;
    const uint32_t colour = own->material < w->paints.count ? w->paints.data[own->material].colour : 0;
    const froe_group group = {.name = node->mName.data, .material = own->name.data, .colour = colour};
    const froe_status status = formats_sink_group(w->sink, &group);
    own->group = w->sink->group;
    return status;
}

/* The group of a face by its colour. */
static froe_status enter_colour(model *w, const struct aiNode *node, const struct aiMesh *mesh,
                                const struct aiFace *face, material_group *own) {
    w->places.count = 0;
    if (!array_reserve(&w->sink->alloc, &w->places, 2 * (size_t)face->mNumIndices))
        return support_fail_memory(w->sink->diag);
    const uint32_t colour =
        assimp_paint_face(w->paints.data + own->material, mesh, face, w->corners.data, w->places.data);
    if (!colour) return enter_material(w, node, own);
    own->colours.name = node->mName.data;
    own->colours.material = own->name.data;
    return formats_paint_enter(w->sink, &own->colours, colour);
}

static froe_status add_face(model *w, const struct aiNode *node, const struct aiMesh *mesh, const struct aiFace *face,
                            material_group *own, bool coloured) {
    w->corners.count = 0;
    for (unsigned i = 0; i < face->mNumIndices; ++i) {
        unsigned at = face->mIndices[i];
        if (at >= mesh->mNumVertices) return corrupt(w, "A face names a vertex that does not exist.");
        if (!array_append(&w->sink->alloc, &w->corners, w->points.data + 3 * (size_t)at, 3))
            return support_fail_memory(w->sink->diag);
    }
    if (!face->mNumIndices) return ++w->sink->report.skipped, FROE_OK;
    const froe_status status = coloured ? enter_colour(w, node, mesh, face, own) : enter_material(w, node, own);
    return status ? status : formats_sink_face(w->sink, w->corners.data, face->mNumIndices);
}

static void leave_node_groups(model *w) {
    for (size_t i = 0; i < w->groups.count; ++i) formats_paint_free(w->sink, &w->groups.data[i].colours);
    w->groups.count = 0;
}

/* m holds the rows of a 3 x 4 matrix. A mesh without faces is a cloud of points. */
static froe_status add_mesh(model *w, const struct aiNode *node, unsigned index, const double *m) {
    if (index >= w->scene->mNumMeshes) return corrupt(w, "A node names a mesh that does not exist.");
    const struct aiMesh *mesh = w->scene->mMeshes[index];
    enum { FACES_PER_REPORT = 8192 };
    const bool cloud = !mesh->mNumFaces;
    const bool coloured = !w->sink->boxes && mesh->mMaterialIndex < w->paints.count &&
                          assimp_paint_varies(w->paints.data + mesh->mMaterialIndex, mesh);
    material_group *own = NULL;
    froe_status status = find_material(w, mesh->mMaterialIndex, &own);
    if (status) return status;
    if (!array_reserve(&w->sink->alloc, &w->points, (size_t)mesh->mNumVertices * 3))
        return support_fail_memory(w->sink->diag);
    double *to = w->points.data;
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) { /* into space */
        const double p[3] = {mesh->mVertices[i].x, mesh->mVertices[i].y, mesh->mVertices[i].z};
        for (int k = 0; k < 3; ++k, ++to)
            *to = m[4 * k] * p[0] + m[4 * k + 1] * p[1] + m[4 * k + 2] * p[2] + m[4 * k + 3];
    }
    for (unsigned i = 0; i < (cloud ? mesh->mNumVertices : mesh->mNumFaces) && !status; ++i) {
        if (!cloud) w->sink->number = i;
        const struct aiFace point = {.mNumIndices = 1, .mIndices = &i};
        status = add_face(w, node, mesh, cloud ? &point : &mesh->mFaces[i], own, coloured);
        if (status || w->faces_done++ % FACES_PER_REPORT) continue;
        const double half = 0.5 * (double)w->faces_done / (double)w->faces;
        status = formats_sink_progress(w->sink, 0.5 + half); /* the import itself was the first half */
    }
    return status;
}

static froe_status read_paints(model *w, const char *path) {
    const unsigned count = w->scene->mNumMaterials;
    froe_status status =
        array_reserve(&w->sink->alloc, &w->paints, count) ? FROE_OK : support_fail_memory(w->sink->diag);
    for (unsigned i = 0; i < count && !status; ++i) {
        status = assimp_paint_read(w->sink, path, w->scene, i, w->linear, &w->images, w->paints.data + i);
        w->paints.count += !status;
    }
    return status;
}

void io_matrix_multiply(const double a[12], const double b[12], double out[12]) {
    for (int i = 0; i < 12; ++i) {
        const double *row = a + i / 4 * 4;
        out[i] = row[0] * b[i % 4] + row[1] * b[4 + i % 4] + row[2] * b[8 + i % 4] + (i % 4 == 3 ? row[3] : 0);
    }
}

/* A node that is still to be listed. */
typedef struct node_visit {
    const struct aiNode *node;
    size_t parent;
} node_visit;

static froe_status list_nodes(model *w) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    ARRAY(node_visit) stack = {0};
    const froe_allocator *alloc = &w->sink->alloc;
    bool room = array_push(alloc, &stack, (node_visit){w->scene->mRootNode, SIZE_MAX});
    while (room && stack.count) {
        const node_visit at = stack.data[--stack.count];
        const struct aiMatrix4x4 *t = &at.node->mTransformation;
        const double own[12] = {t->a1, t->a2, t->a3, t->a4, t->b1, t->b2, t->b3, t->b4, t->c1, t->c2, t->c3, t->c4};
        io_node node = {.node = at.node, .parent = at.parent};
        io_matrix_multiply(at.parent == SIZE_MAX ? identity : w->nodes->data[at.parent].at, own, node.at);
        room = array_push(alloc, w->nodes, node);
        for (unsigned i = at.node->mNumChildren; i-- > 0 && room;)
            room = array_push(alloc, &stack, (node_visit){at.node->mChildren[i], w->nodes->count - 1});
    }
    array_free(alloc, &stack);
    return room ? FROE_OK : support_fail_memory(w->sink->diag);
}

/* Of 3DS with a list of what moves, assimp makes nodes of what is in the list. */
static froe_status tell_lost_meshes(model *w) {
    static const char left[] = "meshes without a node";
    const froe_allocator *alloc = &w->sink->alloc;
    const unsigned count = w->scene->mNumMeshes;
    ARRAY(bool) found = {0};
    if (strncmp(w->sink->report.format, "Discreet 3DS", 12) != 0) return FROE_OK;
    if (!array_reserve(alloc, &found, count)) return support_fail_memory(w->sink->diag);
    for (unsigned i = 0; i < count; i++) found.data[i] = false;
    for (size_t n = 0; n < w->nodes->count; n++) {
        const struct aiNode *node = w->nodes->data[n].node;
        for (unsigned i = 0; i < node->mNumMeshes; i++)
            if (node->mMeshes[i] < count) found.data[node->mMeshes[i]] = true;
    }
    for (unsigned i = 0; i < count; i++)
        if (!found.data[i]) io_leave(w->sink, left, strlen(left));
    array_free(alloc, &found);
    return FROE_OK;
}

static froe_status read_nodes(model *w) {
    froe_status status = FROE_OK;
    for (size_t n = 0; n < w->nodes->count && !status; n++) {
        const struct aiNode *node = w->nodes->data[n].node;
        w->nodes->data[n].first = w->sink->total;
        if (!node->mNumMeshes) continue;
        status = formats_sink_feature(w->sink, w->sink->report.features);
        w->sink->inside = node->mName.data;
        leave_node_groups(w);
        for (unsigned i = 0; i < node->mNumMeshes && !status; ++i)
            status = add_mesh(w, node, node->mMeshes[i], w->nodes->data[n].at);
    }
    return status;
}

/* --------------------------------------------------------------- import -- */

/* assimp reports the exception that ended an import by its text alone. */
static froe_status refuse_import(const formats_source *source, formats_sink *sink) {
    char reason[160];
    const char *said = aiGetErrorString(), *named = strstr(said, source->file), *behind = NULL;
    if (named) behind = strstr(named + strlen(source->file), " - "); /* FILE:LINE - REASON, as of BVH */
    snprintf(reason, sizeof reason, "%.150s", behind ? behind + 3 : named ? "" : said);
    reason[strcspn(reason, "\r\n")] = '\0';
    if (strstr(reason, "bad_alloc")) return support_fail_memory(sink->diag);
    if (*reason)
        return support_fail(sink->diag, FROE_E_FORMAT, "%s: The reader assimp reports '%.120s'.",
                            support_short(source->path), reason);
    if (!strncmp(source->head, "glTF", 4)) /* chunks of odd lengths, or other JSON than text of version 1 or 2 */
        return support_fail(sink->diag, FROE_E_FORMAT, "%s: The file begins as glTF, but is none that assimp can read.",
                            support_short(source->path));
    return support_fail(sink->diag, FROE_E_FORMAT, "%s: The file is of no type that can be read.",
                        support_short(source->path));
}

/* The axis that points up in what assimp hands over. glTF has y up by its specification, and so have X3D, BVH, and the
 * files of AC3D, Blitz3D, DirectX, IQM, Irrlicht, LightWave, MilkShape, Nendo, NFF and Silo. From IFC, 3DS, Blender,
 * Collada and the models of Quake assimp turns the model so that y is up. FBX says it. Other formats are mostly of
 * things that stand on the plane z = 0. */
static int up_of(const struct aiScene *scene, const char *format) {
    static const char *const y_up[] = {"glTF",
                                       "Industry Foundation Classes",
                                       "Discreet 3DS",
                                       "Blender",
                                       "Collada",
                                       "Extensible 3D",
                                       "BVH",
                                       "AC3D",
                                       "BlitzBasic 3D",
                                       "Direct3D XFile",
                                       "Inter-Quake",
                                       "Irrlicht",
                                       "LightWave",
                                       "Milkshape 3D",
                                       "Nendo",
                                       "Neutral File Format",
                                       "Silo SIB",
                                       "Quake II ",
                                       "Quake III Mesh",
                                       "Return To Castle Wolfenstein"};
    for (size_t i = 0; i < sizeof y_up / sizeof *y_up; ++i)
        if (!strncmp(format, y_up[i], strlen(y_up[i]))) return 1;
    const int32_t axis = io_assimp_number(scene, "UpAxis", 2);
    return axis >= 0 && axis <= 2 ? axis : 2;
}

froe_status io_read_assimp(const formats_source *source, formats_sink *sink) {
    io_nodes nodes = {0};
    const froe_status status = io_read_arranged(source, sink, &nodes, NULL, NULL);
    array_free(&sink->alloc, &nodes);
    return status;
}

/* Of the file the first `part` bytes alone; 0: all of it, with that mask. */
static froe_status import(const formats_source *source, formats_sink *sink, size_t part, const io_mask *mask,
                          const struct aiScene **scene) {
    formats_text bytes = {0};
    froe_status status = part ? formats_load_part(source, sink, 0, part, &bytes) : FROE_OK;
    if (status) return array_free(&sink->alloc, &bytes), status;
    io_log log = {.sink = sink};
    bool memory = true;
    pthread_mutex_lock(&import_lock);
    io_log_begin(&log);
    *scene = part ? aiImportFileFromMemory(bytes.data, (unsigned)part, 0, source->extension.text)
             : io_is_gltf(source) || mask->count ? io_import_masked(source->file, mask, &sink->alloc, &memory)
                                                 : aiImportFile(source->file, 0);
    io_log_end();
    status = !memory ? support_fail_memory(sink->diag) : *scene ? FROE_OK : refuse_import(source, sink);
    pthread_mutex_unlock(&import_lock);
    if (!status && *log.damage)
        status = support_fail(sink->diag, FROE_E_FORMAT, "%s: The reader assimp reports '%s'.",
                              support_short(source->path), log.damage);
    array_free(&sink->alloc, &bytes);
    return status;
}

/* Colours of three numbers are opaque in glTF, and assimp has the opacity 0 with them. */
static void make_opaque(const struct aiMesh *mesh) {
    struct aiColor4D *colours = mesh->mColors[0];
    bool seen = !colours;
    for (unsigned i = 0; i < mesh->mNumVertices && !seen; ++i) seen = colours[i].a != 0;
    for (unsigned i = 0; i < mesh->mNumVertices && !seen; ++i) colours[i].a = 1;
}

static froe_status read_scene(const formats_source *source, formats_sink *sink, const struct aiScene *scene,
                              io_nodes *nodes, io_arrange_fn *arrange, void *user) {
    froe_status status;
    model w = {.scene = scene, .sink = sink, .nodes = nodes};
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) /* instances count once: only the progress bar depends on it */
        w.faces += scene->mMeshes[i]->mNumFaces ? scene->mMeshes[i]->mNumFaces : scene->mMeshes[i]->mNumVertices;
    char format[48];
    const char *called = io_assimp_format(scene);
    snprintf(format, sizeof format, "%.40s", *called ? called : source->extension.text);
    char *suffix = strstr(format, " Importer"); /* "glTF2 Importer" becomes "glTF2 (assimp)" */
    if (suffix) *suffix = '\0';
    formats_report_format(sink, "float32", "%s (assimp)", format);
    formats_sink_up(sink, up_of(scene, format));
    if (io_assimp_number(scene, "UpAxisSign", 1) < 0) io_leave(sink, "UpAxisSign -1", 13);
    w.linear = !strncmp(sink->report.format, "glTF", 4);
    for (unsigned i = 0; i < scene->mNumMeshes && w.linear; ++i) make_opaque(scene->mMeshes[i]);
    sink->unit = "face";
    sink->report.layers = 1;
    status = read_paints(&w, source->file);
    if (!status) status = scene->mRootNode ? list_nodes(&w) : corrupt(&w, "The file has no nodes.");
    if (!status) status = tell_lost_meshes(&w);
    if (!status && arrange) status = arrange(user, source, sink, scene, nodes);
    if (!status) status = read_nodes(&w);
    if (!status) status = formats_sink_end_feature(sink);
    sink->inside = NULL; /* it belongs to assimp's scene */
    array_free(&sink->alloc, &w.points);
    array_free(&sink->alloc, &w.corners);
    leave_node_groups(&w);
    array_free(&sink->alloc, &w.groups);
    array_free(&sink->alloc, &w.places);
    array_free(&sink->alloc, &w.paints);
    formats_images_free(&sink->alloc, &w.images);
    return status;
}

froe_status io_read_arranged(const formats_source *source, formats_sink *sink, io_nodes *nodes, io_arrange_fn *arrange,
                             void *user) {
    io_gltf_found found = {.still = !arrange};
    froe_status status = formats_sink_open(sink, 3);
    if (!status) status = formats_sink_progress(sink, 0);
    if (!status && io_is_gltf(source)) status = io_gltf_check(source, sink, &found);
    size_t part = 0;
    if (!status && io_is_stl(source)) status = io_stl_check(source, sink, &part);
    if (!status && io_is_fbx(source)) status = io_fbx_check(source, sink);
    if (!status && io_is_lwo(source)) status = io_lwo_check(source, sink);
    if (!status && io_is_ac(source)) status = io_ac_check(source, sink);
    if (!status && io_is_x(source)) status = io_x_check(source, sink);
    if (!status && io_is_ase(source)) status = io_ase_check(source, sink);
    if (!status && io_is_ifc(source)) status = io_ifc_check(source, sink);
    if (!status && io_is_amf(source)) status = io_amf_check(source, sink, &found.masked);
    if (!status && io_is_x3d(source)) status = io_x3d_check(source, sink);
    if (!status && !strcmp(source->extension.text, "zae")) status = io_stored_check(source, sink);
    if (!status && io_is_collada(source)) status = io_collada_check(source, sink);
    const struct aiScene *scene = NULL;
    if (!status) status = import(source, sink, part, &found.masked, &scene);
    if (!status) status = io_gltf_is_whole(sink, scene, &found);
    const bool incomplete = !status && scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE; /* what it has is made up */
    if (incomplete && (io_is_collada(source) || io_is_ase(source)))
        status = support_fail(sink->diag, FROE_E_INPUT, "%s: The file holds no objects.", support_short(source->path));
    array_free(&sink->alloc, &found.masked);
    if (!status) status = read_scene(source, sink, scene, nodes, arrange, user);
    if (scene) aiReleaseImport(scene);
    return status;
}
