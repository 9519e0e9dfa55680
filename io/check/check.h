/* check.h: what a file says that assimp or GDAL passes over in silence, so that the model or map would be another one.
 * Each format is looked through before, and where it says such a thing it is refused by name. */
#ifndef FROE_IO_CHECK_CHECK_H
#define FROE_IO_CHECK_CHECK_H
#include "formats/input/json.h"
#include "readers.h"
#include <assimp/scene.h>
#include <expat.h>

/** What assimp tells in its log of an import. What it leaves out is in the report. */
typedef struct io_log {
    formats_sink *sink;
    char damage[128]; /**< the first of what makes the model another one; "": nothing */
} io_log;
/** Listens to what assimp tells in this thread, until io_log_end(). */
void io_log_begin(io_log *log);
void io_log_end(void);
/** Puts a name of that length among the sorts in the report that are left out, where it fits and is not yet there. */
void io_leave(formats_sink *sink, const char *name, size_t length);

/** A text of XML that is looked through: the first member of what is known of it. */
typedef struct io_xml {
    formats_sink *sink;
    XML_Parser parser;
    froe_status status; /**< of what was refused: then nothing more is looked at */
} io_xml;
/** Get the io_xml as the user's data; NULL: none. */
typedef struct io_xml_handlers {
    XML_StartElementHandler begin;
    XML_EndElementHandler end;
    XML_CharacterDataHandler text;
} io_xml_handlers;
/** The name of an element without the prefix of its namespace. */
const char *io_xml_local(const char *name);
/** Ends it, with a status whose sentence has been said. */
void io_xml_stop(io_xml *xml, froe_status status);
/** Refuses it for what stands in the present line. */
void io_xml_refuse(io_xml *xml, froe_status status, const char *sentence);
/** Looks through a text; what was refused. *whole: it is well-formed, or as far as it goes; NULL: otherwise it is
 * refused. FROE_E_IO, FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status io_xml_look(io_xml *xml, const formats_source *source, const io_xml_handlers *handlers, bool *whole);
froe_status io_xml_look_at(io_xml *xml, const formats_text *text, const io_xml_handlers *handlers, bool *whole);

/** Loads a file of the virtual file systems of GDAL, such as one in an archive. FROE_E_MEMORY, or FROE_E_FORMAT: it
 * cannot be read, and no sentence says so. */
froe_status io_virtual_load(const char *path, formats_sink *sink, formats_text *text);
/** Looks through a text, and refuses it for what is found. */
typedef froe_status io_look_fn(const formats_text *text, formats_sink *sink);
/** Looks through each file of a zip archive whose name has that extension. FROE_E_FORMAT, FROE_E_MEMORY. */
froe_status io_archive_look(const formats_source *source, formats_sink *sink, const char *extension, io_look_fn *look);

/** What a text is refused for. */
typedef struct io_fault {
    const char *sentence; /**< NULL: nothing */
    size_t line;
    froe_status status;
} io_fault;
/** FROE_OK where there is none. */
froe_status io_text_refuse(const formats_source *source, formats_sink *sink, const io_fault *fault);
/** Looks for the first fault of a text, which ends with a NUL. What the library leaves out may go to the report. */
typedef io_fault io_find_fault(formats_sink *sink, const char *text);
/** Loads a text, as formats_load() does, and refuses it for what is found. */
froe_status io_text_look(const formats_source *source, formats_sink *sink, bool binary, io_find_fault *find);

/** Places in a file of bytes for which assimp gets '_'. */
typedef ARRAY(size_t) io_mask;
/** Imports a file so. Other files that it names are found under their names without escapes such as %20, or as they are
 * written. NULL: assimp has failed, or there is no memory, as *memory says. */
const struct aiScene *io_import_masked(const char *path, const io_mask *mask, const froe_allocator *alloc,
                                       bool *memory);

/** A name without its escapes such as %20; `out` has room for the name as it is. */
void io_unescape(const char *name, char *out);

/** Is it glTF, of any version? */
bool io_is_gltf(const formats_source *source);
enum { IO_GLB_HEADER = 12, IO_GLB_CHUNK = 8 }; /**< bytes before the chunks of a .glb, and before those of each */
/** A whole number of 4 bytes, the lowest first. */
size_t io_word_at(const char *at);
/** Do `size` bytes that begin as a .glb go on as version 2, by a chunk of JSON? */
bool io_glb_is_2(const char *bytes, size_t size);

/** The items of an array of a glTF file. */
typedef ARRAY(const formats_json *) io_gltf_list;
/** Lists those of the array of that name; false: there is no memory. */
bool io_gltf_list_items(const froe_allocator *alloc, const formats_json *root, const char *name, io_gltf_list *list);
/** The item that a member of an object names by its number; NULL: there is none. */
const formats_json *io_gltf_item(const io_gltf_list *list, const formats_json *object, const char *name);
bool io_gltf_is_number(const formats_json *value, double number);
/** How many corners a primitive of a mesh names. */
size_t io_gltf_corners(const io_gltf_list *accessors, const formats_json *primitive);
/** Counts the points, edges and triangles of the meshes that assimp reads. FROE_E_MEMORY. */
froe_status io_gltf_count(formats_sink *sink, const formats_json *root, const io_gltf_list *accessors,
                          const io_gltf_list *meshes, const io_gltf_list *nodes, size_t *faces);

/** What is found before the import and looked at after it. */
typedef struct io_gltf_found {
    bool still;               /**< set before: nodes stand as they are at rest, and no keys replace their rotations */
    size_t faces;             /**< points, edges and triangles of all meshes that assimp reads */
    io_mask masked;           /**< names of members that assimp is not to find */
    formats_json_error error; /**< of a text that is no JSON; line 0: there is none */
} io_gltf_found;

/** Before the import: FROE_E_UNSUPPORTED or FROE_E_FORMAT where a glTF file says something about the places of faces
 * that assimp passes over in silence. The mask is the caller's. */
froe_status io_gltf_check(const formats_source *source, formats_sink *sink, io_gltf_found *found);
/** After it: FROE_E_FORMAT where assimp has left out faces, or has read a text that could not be looked through. */
froe_status io_gltf_is_whole(formats_sink *sink, const struct aiScene *scene, const io_gltf_found *found);
/** Is it STL, by its extension? */
bool io_is_stl(const formats_source *source);
/** Before the import: FROE_E_FORMAT where an STL file is cut off, or has another length than its header says. Behind a
 * binary one there may be bytes, too few for a triangle, that assimp must not see: *whole becomes its length. */
froe_status io_stl_check(const formats_source *source, formats_sink *sink, size_t *whole);
/** Is it FBX, by its extension? */
bool io_is_fbx(const formats_source *source);
/** Before the import: FROE_E_FORMAT or FROE_E_UNSUPPORTED where models of it are each other's parents, or too deep. */
froe_status io_fbx_check(const formats_source *source, formats_sink *sink);
/** Is it a LightWave object of version 6 or later, by its first bytes? */
bool io_is_lwo(const formats_source *source);
/** Before the import: FROE_E_FORMAT where assimp would pass over polygons of it, or name points that do not exist. */
froe_status io_lwo_check(const formats_source *source, formats_sink *sink);
/** Is it DirectX, as text or binary, by its first bytes? */
bool io_is_x(const formats_source *source);
/** Before the import: FROE_E_FORMAT where faces of it name vertices or materials that do not exist. */
froe_status io_x_check(const formats_source *source, formats_sink *sink);
/** Is it ASE, by its extension? */
bool io_is_ase(const formats_source *source);
/** Before the import: FROE_E_FORMAT where lists of it do not fit. */
froe_status io_ase_check(const formats_source *source, formats_sink *sink);
/** Is it AC3D, by its first bytes? */
bool io_is_ac(const formats_source *source);
/** Before the import: FROE_E_FORMAT or FROE_E_UNSUPPORTED where an AC3D file has what assimp reads as another thing. */
froe_status io_ac_check(const formats_source *source, formats_sink *sink);
/** Is it IFC, or of another format of ISO 10303-21, by its first bytes? */
bool io_is_ifc(const formats_source *source);
/** Before the import: FROE_E_FORMAT or FROE_E_UNSUPPORTED where it names what assimp does not find. */
froe_status io_ifc_check(const formats_source *source, formats_sink *sink);
/** Is it X3D, by its extension? */
bool io_is_x3d(const formats_source *source);
/** Before the import: FROE_E_UNSUPPORTED or FROE_E_FORMAT where an X3D file has what assimp reads as something else.
 * What it leaves out is in the report. */
froe_status io_x3d_check(const formats_source *source, formats_sink *sink);
/** Is it AMF, by its extension, and not in an archive? */
bool io_is_amf(const formats_source *source);
/** Before the import: FROE_E_UNSUPPORTED or FROE_E_FORMAT where an AMF file has what assimp reads as something else.
 * The mask, which is the caller's, hides what it reads rightly without. */
froe_status io_amf_check(const formats_source *source, formats_sink *sink, io_mask *mask);
/** Is it COLLADA, perhaps in an archive, by its extension? */
bool io_is_collada(const formats_source *source);
/** Before the import: FROE_E_UNSUPPORTED or FROE_E_FORMAT where a COLLADA file has what assimp passes over in silence.
 * Geometries that are no meshes are counted in the report. */
froe_status io_collada_check(const formats_source *source, formats_sink *sink);
/** FROE_E_FORMAT where a place of a GPX file is not two numbers. */
froe_status io_gpx_check(const formats_source *source, formats_sink *sink);
/** FROE_E_FORMAT where places of a GML file are not numbers. */
froe_status io_gml_check(const formats_source *source, formats_sink *sink);
/** FROE_E_FORMAT where a number of a DXF file is none. That it inserts blocks which are not there is in the report. */
froe_status io_dxf_check(const formats_source *source, formats_sink *sink);
/** Before GDAL opens a file of KML, perhaps in an archive: FROE_E_FORMAT where places of it are not numbers. */
froe_status io_kml_check(const formats_source *source, formats_sink *sink);
/** FROE_E_FORMAT where lines and regions of a MIF file have other points than they count. */
froe_status io_mif_check(const formats_source *source, formats_sink *sink);
/** FROE_E_FORMAT where a file that is stored in a zip archive, without compression, is not what it was. */
froe_status io_stored_check(const formats_source *source, formats_sink *sink);
/** FROE_E_FORMAT where there is more in a file of JSON than one object. The path may be one in the virtual file systems
 * of GDAL. FROE_E_MEMORY. */
froe_status io_json_check(const char *path, formats_sink *sink);
/** FROE_E_FORMAT where geometries of a TopoJSON file name arcs that do not exist. What GDAL leaves out of the layer of
 * that name, or of the first where it is NULL, is in the report. The path may be one in the virtual file systems of
 * GDAL. FROE_E_MEMORY. */
froe_status io_topojson_check(const char *path, const char *layer, formats_sink *sink);
#endif
