/* scenes.c: the script of the demo. */
#include "demo/scenes.h"
#include <stddef.h>

const demo_scene demo_scenes[] = {
    {
        .title = "A floor plan",
        .file = "freedoom-e1m1.geojson",
        .text = "The first map of a game: 812 walls as segments, most of them parallel to an axis. A tree of this kind "
                "is what drew such maps on the machines of 1993: walking it from any point of view yields the walls "
                "in depth order. Walls that no cut crosses stay whole.",
        .credit = "Freedoom 0.12.1, BSD-3-Clause style, © Contributors to the Freedoom project.",
        .dim = 2,
        .steps =
            {
                {"info freedoom-e1m1.geojson", NULL},
                {"build freedoom-e1m1.geojson -o floor.froe", NULL},
                {"check floor.froe", NULL},
                {"draw floor.froe -o floor.svg", "Cells coloured by depth, pale near the root, with walls in ink."},
                {"draw floor.froe -o floor-pieces.svg --show cuts,fragments",
                 "The cuts, heavier near the root, and the pieces they leave."},
                {"export floor.froe -o floor-pieces.geojson", NULL},
            },
    },
    {
        .title = "A map with crossings",
        .file = "countries-110m.json",
        .text =
            "The countries of the world as 10,301 boundary segments. Every shared border is stored twice. Seven "
            "borders of Russia, Fiji and Antarctica run across the whole map, from about -180 to 180 degrees: 155 of "
            "the 157 crossings lie on them. Nothing is snapped, merged or dropped: each crossing is decided "
            "exactly, and every segment is exactly the union of its pieces.",
        .credit = "world-atlas 2.0.2, ISC; Natural Earth, public domain.",
        .dim = 2,
        .steps =
            {
                {"info countries-110m.json", NULL},
                {"build countries-110m.json -o countries.froe", NULL},
                {"check countries.froe", NULL},
                {"draw countries.froe -o countries.svg --width 1200", "The whole world; cells coloured by depth."},
                {"draw countries.froe -o europe.svg --window -12,34,42,72",
                 "Europe: the tree is deeper where borders are."},
            },
    },
    {
        .title = "A house",
        .file = "fzk-haus.glb",
        .text = "A building model as architects exchange it: 35,906 triangles in 110 objects, with thousands of pairs "
                "that intersect or overlap in one plane. Every triangle is cut exactly where the planes of the tree "
                "pass; the audit proves it with exact arithmetic.",
        .credit = "FZK-Haus, KIT/IAI (Karlsruhe Institute of Technology, Institute for Automation and Applied "
                  "Informatics), from assimp's test models.",
        .dim = 3,
        .steps =
            {
                {"info fzk-haus.glb", NULL},
                {"build fzk-haus.glb -o house.froe", NULL},
                {"check house.froe", NULL},
                {"draw house.froe -o house-exploded.png --style exploded --scale 1.5",
                 "Pulled apart along the first cuts of the tree."},
                {"draw house.froe -o house-sections.svg", "Three sections through the middle."},
            },
    },
    {0},
};
