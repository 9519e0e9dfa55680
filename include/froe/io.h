/* io.h: scenes from files of every format, and drawings to DXF.
 *
 *     froe_scene *scene;  froe_read_report report;  froe_diagnostic diag;
 *     froe_read_options o = froe_read_defaults();
 *     if (froe_read("floor.geojson", &o, &scene, &report, &diag)) puts(diag.message);
 *
 * A companion library (link froe-io) on top of froe/formats.h. Plane maps are read by GDAL's OGR, solid models by
 * assimp, numbers in CSV, OFF, OBJ, PLY and plain GeoJSON by the core. Nothing is printed: messages of those libraries
 * go into the diagnostic. All functions may be called from several threads at once. */
#ifndef FROE_IO_H
#define FROE_IO_H

#include <froe/formats.h>
#include <froe/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Reads a scene. The content of the file decides which reader is used, then its extension:
 *
 *   CSV by header, OFF, OBJ, PLY, plain GeoJSON   as froe_read_own() does
 *
 *   assimp          glTF, STL, IFC, FBX, ...: dimension 3, single precision; node transforms are
 *                   applied in double; each pair of a node and a material of its faces is a group,
 *                   with the colour of the material. Points and lines of a model become points and
 *                   segments.
 *
 *   OGR             GeoJSON, TopoJSON, Shapefile, GeoPackage, FlatGeobuf, DXF, OSM, WKT in CSV, ...:
 *                   dimension 2. Lines and polygon rings become one segment per pair of vertices, in
 *                   the order of feature, part, ring, vertex; points become points; the tag is the
 *                   feature's id in its layer. Every polygon feature is a group, and so is any other
 *                   that has a name. The name is the attribute called name, title, label or id, whichever
 *                   comes first in this list, or else the feature's id; `left` or `right` repeats it
 *                   when all rings of the feature have its interior on that one side.
 *
 *                   A folder (.gdb, Shapefiles), a .zip, .tar, .tgz or .gz and every name in GDAL's
 *                   virtual file systems (/vsizip/..., /vsicurl/...) is a map, too. A folder, an
 *                   archive or a GeoPackage of several layers needs the name of one.
 *
 * `face` of an object is the lowest id among those of the same source polygon. With `boxes` every
 * feature gives one box. `report` may be NULL.
 *
 * FROE_E_IO: missing, unreadable, a directory. FROE_E_FORMAT: empty, of no known type, truncated
 * or broken. FROE_E_INPUT: NaN or infinite coordinates, or no objects at all; the message names the
 * feature. FROE_E_OPTIONS: no such layer, a filter OGR cannot apply, either of them
 * for a file that is not a map. FROE_E_UNSUPPORTED: moving
 * features, more than 8 axes. FROE_E_MEMORY, FROE_E_CANCELLED, FROE_E_LIMIT. */
FROE_API froe_status froe_read(const char *path, const froe_read_options *options, froe_scene **out,
                               froe_read_report *report, froe_diagnostic *diag);

/** An animation of a model as a motion of its triangles in space: of glTF 2 (read from the file itself, with steps and
 * splines), and of FBX, Collada and others as assimp hands it over, with straight lines and spherical interpolation
 * between its keys. Times are seconds. Each node that moves, with what hangs on it at rest, is one rigid body
 * (froe_body), and all that rests is another; groups are as froe_read() makes them.
 *
 * A body goes straight and turns along rational arcs from key to key. That is not quite what the file says: turns along
 * an arc of froe_body run ahead and behind, and parts of parts that turn move along curves. So pieces between two keys
 * are halved until no corner is farther from its place than options->deviation times the size of the model allows; the
 * report tells how far one is at most. Where a track steps, the triangles of a part die, and others are born elsewhere.
 * Before the first key and after the last, all stands still.
 *
 * FROE_E_INPUT: no animation; none that moves faces; times that do not increase; NaN; a quaternion whose length is not
 * 1, within 1/122; a node that does not exist. FROE_E_OPTIONS: no animation of that name, or several and no name.
 * FROE_E_UNSUPPORTED: skinned meshes, morph targets that move, scales that change (by more than 2^-10 of them), nodes
 * that turn below one that is scaled by different factors, keys that are compressed, no polygons. A scale that does not
 * change, mirrored ones too, is allowed otherwise. FROE_E_LIMIT: the deviation cannot be kept, or not by
 * 65,536 halvings in all. Otherwise as froe_read() for models. options, report and diag may be NULL. */
FROE_API froe_status froe_read_animation(const char *path, const froe_motion_read_options *options, froe_motion **out,
                                         froe_motion_report *report, froe_diagnostic *diag);

/** Writes a part of a tree as froe_export() does, or in the plane for programs of maps, by extension: .gpkg
 * (GeoPackage), .fgb (FlatGeobuf) or .shp (Shapefile, with its .dbf, .shx, .cpg and .prj), by the writers of OGR. The
 * one layer is called as the file is, has the attributes of froe_tree_parts(), and names the coordinate system of the
 * scene. Atomic: `path` holds the old file or the new one, whole; the files of a Shapefile are replaced one after the
 * other. options may be NULL. Twice the time of froe_tree_parts(), and that of OGR.
 *
 * FROE_E_UNSUPPORTED: another extension or dimension; a GeoPackage with other layers, which would be lost; a Shapefile
 * of several kinds of shapes, with a name of more than 254 bytes or a number of more than 18 digits; a tag of 2^63 or
 * more. FROE_E_IO: cannot be written, disk full. FROE_E_CANCELLED, FROE_E_MEMORY, FROE_E_OPTIONS, FROE_E_ARG. */
FROE_API froe_status froe_export_map(const froe_tree *tree, const char *path, froe_export_what what,
                                     const froe_export_options *options, froe_diagnostic *diag);

/** The lines of the picture of froe_render() as a drawing in DXF (of AutoCAD 2004), by GDAL. They are those of an SVG
 * of the same options, as polylines with 15 digits, in units of the page, y upwards from its lower left corner. With a
 * page in millimetres the drawing says so, and otherwise it names no unit. Each kind of line has a layer:
 * VISIBLE-SILHOUETTE, HIDDEN-CREASE. With FROE_LAYERS_OBJECT each object has two: WALL-VISIBLE, WALL-HIDDEN. Signs that
 * DXF does not have are underscores in them, and characters beyond ASCII are like U+00FC.
 *
 * A layer has the look of the first path on it: its colour (the nearest of AutoCAD's 255, and the exact one; black and
 * FROE_LINE_COLOUR are 7, which is black on white and white on black), its dashes as a type of line (DASHED, DASHED2
 * and so on) and, in millimetres, the nearest width that DXF has. What has another colour has it by itself. Shapes,
 * background and title are left out.
 *
 * `path` may have any name. FROE_E_UNSUPPORTED: GDAL has no DXF driver, or not its data. Otherwise as froe_render(). */
FROE_API froe_status froe_render_dxf(const froe_tree *tree, const char *path, const froe_render_options *options,
                                     froe_render_report *report, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
