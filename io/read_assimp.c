/* read_assimp.c: solid models in all formats of assimp, as they are in the
 * file: no post-processing step of assimp runs, for those that weld, drop or split do
 * so within tolerances. Its coordinates are single precision; node transforms are
 * multiplied out in double. Nodes are walked with an explicit stack. */
#include "formats/input/colour.h"
#include "readers.h"
#include <assimp/GltfMaterial.h>
#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/metadata.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <math.h>
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

/* A node to visit, with the transform of its parent (rows of a 3 x 4 matrix). */
typedef struct visit {
    const struct aiNode *node;
    double parent[12];
} visit;

typedef struct material_group {
    unsigned material;
    uint32_t group;
} material_group;

typedef struct model {
    const struct aiScene *scene;
    formats_sink *sink;
    ARRAY(visit) stack;
    ARRAY(double) points;         /* transformed vertices of a mesh, 3 each */
    ARRAY(double) corners;        /* of a face, 3 each */
    ARRAY(material_group) groups; /* of the current node */
    uint64_t faces, faces_done;
    bool linear; /* colours are shares of light (glTF), not of sRGB */
} model;

static froe_status corrupt(model *w, const char *sentence) {
    return support_fail(w->sink->diag, FROE_E_FORMAT, "%s: %s", support_short(w->sink->path), sentence);
}

static froe_status add_face(model *w, const struct aiMesh *mesh, const struct aiFace *face) {
    w->corners.count = 0;
    for (unsigned i = 0; i < face->mNumIndices; ++i) {
        unsigned at = face->mIndices[i];
        if (at >= mesh->mNumVertices) return corrupt(w, "A face names a vertex that does not exist.");
        if (!array_append(&w->sink->alloc, &w->corners, w->points.data + 3 * (size_t)at, 3))
            return support_fail_memory(w->sink->diag);
    }
    if (!face->mNumIndices) return ++w->sink->report.skipped, FROE_OK;
    return formats_sink_face(w->sink, w->corners.data, face->mNumIndices);
}

static const char *material_name(model *w, unsigned index, struct aiString *name) {
    *name = (struct aiString){.length = 0};
    if (index < w->scene->mNumMaterials) aiGetMaterialString(w->scene->mMaterials[index], AI_MATKEY_NAME, name);
    return name->data;
}

/* 0: there is none, or it is made up by assimp, or a picture says it. */
static uint32_t material_colour(model *w, unsigned index) {
    struct aiColor4D c;
    struct aiString name;
    if (index >= w->scene->mNumMaterials || !strcmp(material_name(w, index, &name), AI_DEFAULT_MATERIAL_NAME)) return 0;
    const struct aiMaterial *material = w->scene->mMaterials[index];
    if (aiGetMaterialTextureCount(material, aiTextureType_DIFFUSE) ||
        aiGetMaterialTextureCount(material, aiTextureType_BASE_COLOR))
        return 0;
    if (aiGetMaterialColor(material, AI_MATKEY_BASE_COLOR, &c) &&
        aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &c))
        return 0;
    struct aiString blending = {.length = 0};
    float opacity = 1;
    /* aiGetMaterialFloat() is inline in the header and not in the library: without optimisation it does not link. */
    if (aiGetMaterialString(material, AI_MATKEY_GLTF_ALPHAMODE, &blending))
        aiGetMaterialFloatArray(material, AI_MATKEY_OPACITY, &opacity, NULL);
    else if (!strcmp(blending.data, "BLEND")) /* in glTF only these materials are transparent */
        opacity = c.a;
    double rgba[4] = {c.r, c.g, c.b, opacity};
    for (int k = 0; w->linear && k < 3; k++) /* from shares of light to sRGB (IEC 61966-2-1) */
        rgba[k] = rgba[k] <= 0.0031308 ? 12.92 * rgba[k] : 1.055 * pow(rgba[k], 1 / 2.4) - 0.055;
    return formats_colour(rgba);
}

/* One group for each node and name of a material, or with `boxes` for each node. */
static froe_status enter_node_group(model *w, const struct aiNode *node, unsigned material) {
    struct aiString name, other;
    material_name(w, material, &name);
    for (size_t i = 0; i < w->groups.count; ++i) {
        const material_group *known = w->groups.data + i;
        bool same = w->sink->boxes || known->material == material ||
                    !strcmp(material_name(w, known->material, &other), name.data);
        if (same) return w->sink->group = known->group, FROE_OK;
    }
    froe_group group = {.name = node->mName.data, .material = name.data, .colour = material_colour(w, material)};
    froe_status status = formats_sink_group(w->sink, &group);
    if (status) return status;
    const material_group added = {material, w->sink->group};
    return array_push(&w->sink->alloc, &w->groups, added) ? FROE_OK : support_fail_memory(w->sink->diag);
}

/* m holds the rows of a 3 x 4 matrix. A mesh without faces is a cloud of points. */
static froe_status add_mesh(model *w, const struct aiNode *node, unsigned index, const double *m) {
    if (index >= w->scene->mNumMeshes) return corrupt(w, "A node names a mesh that does not exist.");
    const struct aiMesh *mesh = w->scene->mMeshes[index];
    enum { FACES_PER_REPORT = 8192 };
    const bool cloud = !mesh->mNumFaces;
    froe_status status = enter_node_group(w, node, mesh->mMaterialIndex);
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
        status =
            cloud ? formats_sink_point(w->sink, w->points.data + 3 * (size_t)i) : add_face(w, mesh, &mesh->mFaces[i]);
        if (status || w->faces_done++ % FACES_PER_REPORT) continue;
        const double half = w->faces ? 0.5 * (double)w->faces_done / (double)w->faces : 0.5;
        status = formats_sink_progress(w->sink, 0.5 + half); /* the import itself was the first half */
    }
    return status;
}

static froe_status push(model *w, const struct aiNode *node, const double *parent) {
    visit next = {.node = node};
    memcpy(next.parent, parent, sizeof next.parent);
    return array_push(&w->sink->alloc, &w->stack, next) ? FROE_OK : support_fail_memory(w->sink->diag);
}

static froe_status walk_nodes(model *w) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    froe_status status = push(w, w->scene->mRootNode, identity);
    while (!status && w->stack.count) {
        const visit at = w->stack.data[--w->stack.count];
        const struct aiNode *node = at.node;
        const struct aiMatrix4x4 *t = &node->mTransformation;
        const double own[12] = {t->a1, t->a2, t->a3, t->a4, t->b1, t->b2, t->b3, t->b4, t->c1, t->c2, t->c3, t->c4};
        double m[12];
        for (int i = 0; i < 12; ++i) {
            const double *row = at.parent + i / 4 * 4;
            m[i] = row[0] * own[i % 4] + row[1] * own[4 + i % 4] + row[2] * own[8 + i % 4] + (i % 4 == 3 ? row[3] : 0);
        }
        if (node->mNumMeshes) {
            status = formats_sink_feature(w->sink, w->sink->report.features);
            w->sink->inside = node->mName.data;
            w->groups.count = 0;
        }
        for (unsigned i = 0; i < node->mNumMeshes && !status; ++i) status = add_mesh(w, node, node->mMeshes[i], m);
        for (unsigned i = node->mNumChildren; i-- > 0 && !status;) status = push(w, node->mChildren[i], m);
    }
    return status;
}

/* --------------------------------------------------------------- import -- */

/* assimp reports the exception that ended an import by its text alone. */
static froe_status refuse_import(const formats_source *source, formats_sink *sink) {
    char reason[160];
    const char *said = aiGetErrorString();
    snprintf(reason, sizeof reason, "%.150s", strstr(said, source->file) ? "" : said);
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
    for (unsigned i = 0; scene->mMetaData && i < scene->mMetaData->mNumProperties; ++i) {
        const struct aiMetadataEntry *entry = &scene->mMetaData->mValues[i];
        int32_t axis;
        if (strcmp(scene->mMetaData->mKeys[i].data, "UpAxis") != 0 || entry->mType != AI_INT32) continue;
        memcpy(&axis, entry->mData, sizeof axis);
        if (axis >= 0 && axis <= 2) return axis;
    }
    return 2;
}

froe_status io_read_assimp(const formats_source *source, formats_sink *sink) {
    froe_status status = formats_sink_open(sink, 3);
    if (!status) status = formats_sink_progress(sink, 0);
    if (status) return status;
    pthread_mutex_lock(&import_lock);
    const struct aiScene *scene = aiImportFile(source->file, 0);
    if (!scene) status = refuse_import(source, sink);
    pthread_mutex_unlock(&import_lock);
    if (status) return status;
    model w = {.scene = scene, .sink = sink};
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) /* instances count once: only the progress bar depends on it */
        w.faces += scene->mMeshes[i]->mNumFaces ? scene->mMeshes[i]->mNumFaces : scene->mMeshes[i]->mNumVertices;
    char format[48];
    snprintf(format, sizeof format, "%s", source->extension.text);
    for (unsigned i = 0; scene->mMetaData && i < scene->mMetaData->mNumProperties; ++i) {
        const struct aiMetadataEntry *entry = &scene->mMetaData->mValues[i];
        if (strcmp(scene->mMetaData->mKeys[i].data, AI_METADATA_SOURCE_FORMAT) || entry->mType != AI_AISTRING) continue;
        snprintf(format, sizeof format, "%.40s", ((const struct aiString *)entry->mData)->data);
    }
    char *suffix = strstr(format, " Importer"); /* "glTF2 Importer" becomes "glTF2 (assimp)" */
    if (suffix) *suffix = '\0';
    formats_report_format(sink, "float32", "%s (assimp)", format);
    formats_sink_up(sink, up_of(scene, format));
    w.linear = !strncmp(sink->report.format, "glTF", 4);
    sink->unit = "face";
    sink->report.layers = 1;
    status = scene->mRootNode ? walk_nodes(&w) : corrupt(&w, "The file has no nodes.");
    if (!status) status = formats_sink_end_feature(sink);
    sink->inside = NULL; /* it belongs to assimp's scene */
    array_free(&sink->alloc, &w.stack);
    array_free(&sink->alloc, &w.points);
    array_free(&sink->alloc, &w.corners);
    array_free(&sink->alloc, &w.groups);
    aiReleaseImport(scene);
    return status;
}
