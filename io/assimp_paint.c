/* assimp_paint.c: see assimp_paint.h. */
#include "assimp_paint.h"
#include "formats/input/colour.h"
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* -------------------------------------------------------------------- materials -- */

/* Opacity, and in glTF what it means: see formats_texture. */
static double opacity_of(const struct aiMaterial *material, double alpha, double *cutoff) {
    struct aiString mode = {.length = 0};
    float opacity = 1, least = 0.5f;
    *cutoff = 0;
    /* aiGetMaterialFloat() is inline in the header and not in the library: without optimisation it does not link. */
    if (aiGetMaterialString(material, AI_MATKEY_GLTF_ALPHAMODE, &mode)) {
        aiGetMaterialFloatArray(material, AI_MATKEY_OPACITY, &opacity, NULL);
        return opacity;
    }
    if (!strcmp(mode.data, "BLEND")) return alpha; /* only these materials are transparent */
    if (!strcmp(mode.data, "MASK")) aiGetMaterialFloatArray(material, AI_MATKEY_GLTF_ALPHACUTOFF, &least, NULL);
    *cutoff = !strcmp(mode.data, "MASK") && least > 0 ? least : -1;
    return 1;
}

/* Is there a colour that is not made up by assimp? */
static bool read_colour(const struct aiMaterial *material, assimp_paint *out) {
    struct aiColor4D c;
    struct aiString name = {.length = 0};
    aiGetMaterialString(material, AI_MATKEY_NAME, &name);
    const bool there = strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) != 0 &&
                       (aiGetMaterialColor(material, AI_MATKEY_BASE_COLOR, &c) == aiReturn_SUCCESS ||
                        aiGetMaterialColor(material, AI_MATKEY_COLOR_DIFFUSE, &c) == aiReturn_SUCCESS);
    const double opacity = opacity_of(material, there ? c.a : 1, &out->texture.cutoff);
    const double rgba[4] = {there ? c.r : 1, there ? c.g : 1, there ? c.b : 1, opacity};
    memcpy(out->factor, rgba, sizeof rgba);
    return there;
}

/* A colour of shares of light is one of sRGB (IEC 61966-2-1). */
static uint32_t colour_of(const double rgba[4], bool linear) {
    double out[4];
    for (int k = 0; k < 4; k++) out[k] = rgba[k];
    for (int k = 0; linear && k < 3; k++)
        out[k] = out[k] <= 0.0031308 ? 12.92 * out[k] : 1.055 * pow(out[k], 1 / 2.4) - 0.055;
    return formats_colour(out);
}

/* --------------------------------------------------------------------- textures -- */

static formats_wrap wrap_of(enum aiTextureMapMode mode) {
    return mode == aiTextureMapMode_Wrap     ? FORMATS_REPEAT
           : mode == aiTextureMapMode_Mirror ? FORMATS_MIRROR
                                             : FORMATS_CLAMP;
}

/* The image that a name stands for within the file ("*0", or its name there); NULL: it is a file. */
static const struct aiTexture *embedded(const struct aiScene *scene, const char *name) {
    char *end;
    const unsigned long number = *name == '*' ? strtoul(name + 1, &end, 10) : 0;
    if (*name == '*') return end != name + 1 && number < scene->mNumTextures ? scene->mTextures[number] : NULL;
    for (unsigned i = 0; i < scene->mNumTextures; i++)
        if (*scene->mTextures[i]->mFilename.data && !strcmp(scene->mTextures[i]->mFilename.data, name))
            return scene->mTextures[i];
    return NULL;
}

/* The name of an image as paths have it: without %20 and the like, and with slashes. */
static void clean_name(const char *name, char *out, size_t room) {
    size_t used = 0;
    for (; *name && used + 1 < room; name++) {
        const char digits[3] = {name[0] == '%' ? name[1] : '\0', name[0] == '%' && name[1] ? name[2] : '\0', '\0'};
        char *end;
        const long byte = strtol(digits, &end, 16);
        const bool escaped = digits[0] && digits[1] && end == digits + 2 && byte > 0;
        out[used++] = escaped ? (char)byte : *name == '\\' ? '/' : *name;
        if (escaped) name += 2;
    }
    out[used] = '\0';
}

/* Uncompressed texels of the file: blue, green, red, opacity. */
static froe_image raw_image(const struct aiTexture *raw, const froe_allocator *alloc) {
    froe_image out = {.width = raw->mWidth, .height = raw->mHeight};
    out.pixels = support_calloc(alloc, 4 * (size_t)out.width, out.height);
    for (size_t i = 0; out.pixels && i < (size_t)out.width * out.height; i++) {
        const struct aiTexel *t = raw->pcData + i;
        const uint8_t rgba[4] = {t->r, t->g, t->b, t->a};
        memcpy(out.pixels + 4 * i, rgba, sizeof rgba);
    }
    return out;
}

static froe_status find_image(formats_sink *sink, const char *path, const struct aiScene *scene, const char *name,
                              formats_images *images, froe_image *out) {
    char place[300];
    const struct aiTexture *inside = embedded(scene, name);
    if (!inside) {
        clean_name(name, place, sizeof place);
        return formats_image_find(sink, path, place, NULL, 0, images, out);
    }
    if (!inside->mHeight) return formats_image_find(sink, path, name, inside->pcData, inside->mWidth, images, out);
    for (size_t i = 0; i < images->count; i++)
        if (!strcmp(images->data[i].name, name)) return *out = images->data[i].image, FROE_OK;
    formats_image found = {.image = {.pixels = NULL}};
    snprintf(found.name, sizeof found.name, "%.250s", name);
    if (array_reserve(&sink->alloc, images, 1)) found.image = raw_image(inside, &sink->alloc);
    if (!found.image.pixels) return support_fail_memory(sink->diag);
    images->data[images->count++] = found;
    *out = found.image;
    sink->report.textures++;
    return FROE_OK;
}

froe_status assimp_paint_read(formats_sink *sink, const char *path, const struct aiScene *scene, unsigned index,
                              bool linear, formats_images *images, assimp_paint *out) {
    *out = (assimp_paint){.scene = scene, .linear = linear, .factor = {1, 1, 1, 1}};
    const struct aiMaterial *material = scene->mMaterials[index];
    const bool coloured = read_colour(material, out);
    static const enum aiTextureType types[] = {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE};
    struct aiString name;
    enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    for (int i = 0; i < 2 && !out->textured; i++) {
        out->textured = aiGetMaterialTexture(material, types[i], 0, &name, NULL, &out->channel, NULL, NULL, modes,
                                             NULL) == aiReturn_SUCCESS;
        struct aiUVTransform change;
        const bool moved = out->textured && aiGetMaterialUVTransform(material, AI_MATKEY_UVTRANSFORM(types[i], 0),
                                                                     &change) == aiReturn_SUCCESS;
        out->texture.scale[0] = moved ? change.mScaling.x : 1, out->texture.scale[1] = moved ? change.mScaling.y : 1;
        out->texture.offset[0] = moved ? change.mTranslation.x : 0;
        out->texture.offset[1] = moved ? change.mTranslation.y : 0;
    }
    for (int k = 0; k < 2; k++) out->texture.wrap[k] = wrap_of(modes[k]);
    if (out->textured && !sink->boxes) {
        const froe_status status = find_image(sink, path, scene, name.data, images, &out->texture.image);
        if (status) return status;
    }
    /* Beside a texture the colour is a factor in glTF, and otherwise often one that nothing shows. */
    if (coloured && (linear || !out->textured)) out->colour = colour_of(out->factor, linear);
    return FROE_OK;
}

/* ------------------------------------------------------------------------- faces -- */

static bool has_places(const assimp_paint *p, const struct aiMesh *mesh) {
    return p->texture.image.pixels && p->channel < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh->mTextureCoords[p->channel];
}

bool assimp_paint_varies(const assimp_paint *p, const struct aiMesh *mesh) {
    return mesh->mColors[0] || has_places(p, mesh);
}

uint32_t assimp_paint_face(const assimp_paint *p, const struct aiMesh *mesh, const struct aiFace *face,
                           const double *corners, double *places) {
    const unsigned count = face->mNumIndices;
    double rgba[4] = {1, 1, 1, 1}, texel[4];
    for (int k = 0; k < 4 && p->linear; k++) rgba[k] = p->factor[k];
    if (mesh->mColors[0]) {
        double sum[4] = {0};
        for (unsigned i = 0; i < count; i++) {
            const struct aiColor4D *c = mesh->mColors[0] + face->mIndices[i];
            const double own[4] = {c->r, c->g, c->b, c->a};
            for (int k = 0; k < 4; k++) sum[k] += own[k] / count;
        }
        const bool opaque = p->linear && p->texture.cutoff != 0;
        for (int k = 0; k < 4; k++) rgba[k] *= k == 3 && opaque ? 1 : sum[k];
        const bool none = sum[0] == 0 && sum[1] == 0 && sum[2] == 0 && sum[3] == 0; /* so assimp has it of AMF */
        if (!p->linear) return none ? p->colour : formats_step_colour(colour_of(rgba, false));
    }
    if (count > 2 && has_places(p, mesh)) {
        for (unsigned i = 0; i < count; i++) {
            const struct aiVector3D *at = mesh->mTextureCoords[p->channel] + face->mIndices[i];
            places[2 * i] = at->x, places[2 * i + 1] = at->y;
        }
        if (!p->linear) rgba[3] = p->factor[3];
        (void)formats_texture_mean(&p->texture, corners, places, count, texel);
        for (int k = 0; k < 4; k++) rgba[k] *= texel[k];
        return formats_light_colour(rgba);
    }
    return p->linear ? formats_light_colour(rgba) : p->colour;
}
