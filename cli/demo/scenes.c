/* scenes.c: the script of the demo: what froe is for, and then how it works. */
#include "demo/scenes.h"
#include <stddef.h>

#define HOUSE_CREDIT                                                                                                   \
    "The house is FZK-Haus by the Karlsruhe Institute of Technology (KIT), Institute for Automation and Applied "      \
    "Informatics (IAI)."
#define COUNTRIES_CREDIT "The countries are from world-atlas 2.0.2, ISC; Natural Earth, public domain."

const demo_scene demo_scenes[] = {
    {
        .title = "From a model to a drawing",
        .text = "A model of a house with 35,906 triangles becomes a vector drawing. What is hidden is decided exactly, "
                "so the files hold few shapes, without cracks.",
        .files = {"fzk-haus.glb"},
        .steps =
            {
                {.command =
                     "render fzk-haus.glb -o house-turning.svg --turntable 18 --animate --seconds 6 --preset web "
                     "--size 900x640 --decimals 0 --min-area 3 --cull-back --line-kinds border,silhouette,object",
                 .caption = "On a turntable: 18 drawings in one file, which any browser plays.",
                 .text = "A house with an orange roof turns around once in six seconds",
                 .still = "house.svg"},
                {.command = "render fzk-haus.glb -o house.svg --size 900x640",
                 .caption = "One line, one drawing. It can be scaled, printed and edited.",
                 .text = "The house, seen from a corner and from above"},
            },
        .credit = HOUSE_CREDIT,
    },
    {
        .title = "Hidden lines, dashed",
        .text = "For manuals, plans and plotters: lines by their kind, those behind other parts dashed. Each ends "
                "exactly where it goes behind something.",
        .files = {"bracket.off"},
        .steps =
            {
                {.command = "render bracket.off -o bracket-lines.svg --preset technical --view iso --size 900x800 "
                            "--line-width 1.6",
                 .caption = "A technical drawing: borders strong, edges fine, hidden ones dashed.",
                 .text = "Line drawing of an angle bracket with two holes and a ring; hidden edges are dashed"},
                {.command = "render bracket.off -o bracket.svg --view iso --size 900x800",
                 .caption = "The same part in shades.",
                 .text = "The bracket with shaded faces"},
            },
    },
    {
        .title = "Where is this point?",
        .text = "Eleven places on a map of 177 countries: which country is each in? Answers are exact, on borders, "
                "too. The place in the sea has none.",
        .files = {"countries-110m.json", "towns.csv"},
        .steps =
            {
                {.command = "locate countries-110m.json --wrap --groups --queries towns.csv --columns "
                            "lon,lat,town,name >answers.csv"},
                {.command =
                     "draw countries-110m.json --wrap -o answers.svg --show objects --no-legend --marks answers.csv",
                 .caption = "The first line asks, and the second draws what was asked and answered.",
                 .text = "A map of the world with ten marked places and the names of their countries"},
            },
        .credit = COUNTRIES_CREDIT,
    },
    {
        .title = "What does a ray hit?",
        .text = "From a place in the living room, 1.4 metres above the floor, 90 rays go out in all directions. Each "
                "ends at the first of 35,906 triangles that it meets.",
        .files = {"sight.csv"},
        .steps =
            {
                {.command = "ray fzk-haus.glb --queries sight.csv --columns ox,oy,oz,point >hits.csv"},
                {.command = "draw fzk-haus.glb -o hits.svg --section y=1.4 --window=-0.5,0,-10.5,12.5,3,0.5 --show "
                            "objects --no-legend --marks hits.csv",
                 .caption = "A section through the house, with the rays in it.",
                 .text = "Floor plan of the house; rays from one room end at its walls, windows and furniture"},
            },
        .credit = HOUSE_CREDIT,
    },
    {
        .title = "When do moving things meet?",
        .text = "548 cars and bicycles drive for some seconds through Bologna. froe finds every contact between them, "
                "and the exact moments at which it begins and ends.",
        .files = {"cars-bologna.mfjson"},
        .steps =
            {
                {.command = "simulate cars-bologna.mfjson --from 303000 --to 311000 --contacts contacts.csv --animate "
                            "cars.svg --player cars.html --seconds 16",
                 .caption = "Vehicles in contact are orange. The marks below are the times of contacts. <a "
                            "href=\"cars.html\">Open the player</a> to stop at each.",
                 .text = "A map of streets on which some 500 vehicles move"},
            },
        .credit = "Traffic simulated with Eclipse SUMO on its network of Bologna, © German Aerospace Center (DLR) and "
                  "others, EPL-2.0 or GPL-2.0-or-later.",
    },
    {
        .title = "How it works",
        .text =
            "froe cuts space in two, and each half again, until every cell holds next to nothing. Such a binary space "
            "partition is a tree; it tells what is in front of what, and finds what is near a place without looking at "
            "the rest. Cuts that divide few objects make small trees. Every tree can be checked, in exact arithmetic.",
        .files = {"freedoom-e1m1.geojson"},
        .steps =
            {
                {.command = "build freedoom-e1m1.geojson -o floor.froe"},
                {.command = "check floor.froe"},
                {.command = "draw floor.froe -o floor.svg --no-legend",
                 .caption = "The floor plan of a game. The deeper a cell lies in the tree, the darker it is. Of a "
                            "wall that cuts divide, every second piece is red.",
                 .text = "A floor plan with cells coloured by depth"},
                {.command = "build countries-110m.json --wrap -o countries.froe"},
                {.command = "check countries.froe"},
                {.command = "draw countries.froe -o countries.png --scale 1.5 --no-legend",
                 .caption = "The countries of the world.",
                 .text = "A map of the world with the cells of its partition"},
                {.command = "build fzk-haus.glb -o house.froe"},
                {.command = "check house.froe"},
                {.command = "draw house.froe -o house-exploded.png --style exploded --no-legend",
                 .caption = "The house, pulled apart along the first cuts of its tree.",
                 .text = "The house in sixteen parts that float apart"},
            },
        .methods = "freedoom-e1m1.geojson",
        .credit = "The floor plan is that of map E1M1 of Freedoom 0.12.1, BSD-3-Clause, © Contributors to the Freedoom "
                  "project. " COUNTRIES_CREDIT " " HOUSE_CREDIT,
    },
    {0},
};
