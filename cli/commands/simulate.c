/* simulate.c: froe simulate, what moving objects do. */
#include "command.h"
#include "exit.h"
#include "files.h"
#include "motion/follow.h"
#include "motion/moving.h"
#include "progress.h"
#include "report/report.h"
#include "support/path.h"
#include <froe/io.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct simulate_args {
    cli_common common;
    cli_moving_args moving;
    const char *contacts, *animate, *player;
    double seconds; /* NaN: the library's default */
    bool first, apart;
    cli_follow follow;
} simulate_args;

static const cli_option operand[] = {
    {NULL, 0, CLI_TEXT, offsetof(simulate_args, moving.path), "MOVING", .file = CLI_READ,
     .help = "moving features (MF-JSON), or a model with an animation; - is standard input", .required = true},
    {"input-format", 0, CLI_TEXT, offsetof(simulate_args, moving.format), "EXT",
     .help = "of MOVING from standard input or a pipe: the usual extension of its files (default: mfjson)"},
    {0},
};

static const cli_option options[] = {
    {"contacts", 0, CLI_TEXT, offsetof(simulate_args, contacts), "FILE", .file = CLI_WRITTEN,
     .help = "write all contacts, with their times, as .csv or .json"},
    {"first", 0, CLI_FLAG, offsetof(simulate_args, first),
     .help = "only the first contact of all, and those that begin with it"},
    {"apart", 0, CLI_FLAG, offsetof(simulate_args, apart), .help = "leave out contacts within one feature"},
    {"events", 0, CLI_TEXT, offsetof(simulate_args, follow.events), "FILE", .file = CLI_WRITTEN,
     .help = "follow the partition, and write what changes it, with the times, as .csv"},
    {"at", 0, CLI_REAL, offsetof(simulate_args, follow.at), "T", .help = "with --output: the time of the tree"},
    {"output", 'o', CLI_OUTPUT, offsetof(simulate_args, follow.tree), "TREE", .file = CLI_WRITTEN,
     .help = "save the partition as it is at the time of --at, as a tree for all other commands", .ending = "froe"},
    {"places", 0, CLI_TEXT, offsetof(simulate_args, follow.places), "FILE", .file = CLI_WRITTEN,
     .help = "with --output: write where the tree's vertices are exactly, as quotients of whole numbers, as .csv"},
    {"unrounded", 0, CLI_FLAG, offsetof(simulate_args, follow.unrounded),
     .help = "with --output: fail if a coordinate is no double and would have to be rounded"},
    {"augmented", 0, CLI_FLAG, offsetof(simulate_args, follow.augmented),
     .help = "with --events: segments that turn upright cost nothing, however many they cross"},
    {"ghosts", 0, CLI_FLAG, offsetof(simulate_args, follow.ghosts),
     .help = "with --events or --at, in space: of two triangles that meet, the later one of the file is left out "
             "meanwhile; without it, events end there"},
    {"animate", 0, CLI_TEXT, offsetof(simulate_args, animate), "FILE", .file = CLI_WRITTEN,
     .help = "write an animated picture, .svg"},
    {"player", 0, CLI_TEXT, offsetof(simulate_args, player), "FILE", .file = CLI_WRITTEN,
     .help = "write a page that plays the motion, .html"},
    {"seconds", 0, CLI_REAL, offsetof(simulate_args, seconds), "S",
     .help = "picture and page play for S seconds (default 20)"},
    {0},
};

static const cli_part parts[] = {{"Moving", operand, 0},
                                 {"Motion", cli_moving_options, offsetof(simulate_args, moving)},
                                 {"Simulate", options, 0},
                                 {"Options", cli_common_options, 0},
                                 {0}};

typedef struct simulation {
    const simulate_args *args;
    froe_motion *motion;
    froe_motion_report read;
    froe_contact *contacts;
    size_t count, room, instants;
    froe_contact_statistics statistics;
    double seconds;
    bool full;
    json_t *events;
    cli_written written;
} simulation;

static bool keep(void *user, const froe_contact *contact) {
    simulation *s = user;
    if (s->count == s->room) {
        const size_t room = 2 * s->room + 64;
        froe_contact *more = realloc(s->contacts, room * sizeof *more);
        s->full = !more;
        if (!more) return false;
        s->contacts = more;
        s->room = room;
    }
    s->contacts[s->count++] = *contact;
    s->instants += contact->instant;
    return true;
}

static int find_contacts(simulation *s) {
    froe_diagnostic diag;
    cli_progress bar = cli_progress_begin(&s->args->common, "searching");
    froe_contact_options o = froe_contact_defaults();
    o.first = s->args->first;
    o.apart = s->args->apart;
    o.threads = (unsigned)s->args->common.threads;
    o.statistics = &s->statistics;
    o.progress = cli_progress_step;
    o.user = &bar;
    const double start = cli_seconds();
    const froe_status status = froe_motion_contacts(s->motion, &o, keep, s, &diag);
    s->seconds = cli_seconds() - start;
    cli_progress_end(&bar);
    if (s->full) return cli_fail_memory();
    return status ? cli_fail_status(CLI_WORKING, s->args->moving.path, status, &diag) : 0;
}

static int animate(simulation *s, const char *path) {
    froe_diagnostic diag;
    froe_animation_options o = froe_animation_defaults();
    if (!path) return 0;
    if (!isnan(s->args->seconds)) o.seconds = s->args->seconds;
    o.up = s->read.up;
    o.numbers = s->read.extent > 0 || s->args->moving.poses; /* seconds of a model, or numbers of a table */
    const froe_status status = froe_animate(s->motion, s->contacts, s->count, &o, path, &diag);
    if (!status) s->written.names[s->written.count++] = path;
    return status ? cli_fail_status(CLI_WRITING, path, status, &diag) : 0;
}

static int report(const simulation *s) {
    const froe_motion_options window = froe_motion_window(s->motion);
    const froe_contact *c = s->contacts;
    json_t *all = json_pack(
        "{s:I, s:I, s:I, s:I, s:I, s:I}", "objects", (json_int_t)froe_motion_object_count(s->motion), "vertices",
        (json_int_t)froe_motion_vertex_count(s->motion), "features", (json_int_t)s->read.features, "still",
        (json_int_t)s->read.still, "pieces", (json_int_t)s->read.pieces, "flattened", (json_int_t)s->read.flattened);
    cli_report_moving(&s->read, all);
    json_t *first = !s->count ? json_null()
                              : json_pack("{s:I, s:I, s:f, s:f}", "a", (json_int_t)c->a, "b", (json_int_t)c->b,
                                          "begin_low", c->begin[0], "begin_high", c->begin[1]);
    json_t *found =
        json_pack("{s:I, s:I, s:o}", "all", (json_int_t)s->count, "instants", (json_int_t)s->instants, "first", first);
    json_t *work = json_pack("{s:I, s:I, s:I}", "boxes", (json_int_t)s->statistics.boxes, "candidates",
                             (json_int_t)s->statistics.candidates, "exact", (json_int_t)s->statistics.exact);
    json_t *seconds = json_pack("{s:f, s:f}", "read", s->read.seconds, "contacts", s->seconds);
    return cli_report(&s->args->common, NULL,
                      json_pack("{s:o, s:{s:f, s:f}, s:o, s:o, s:O, s:o, s:o}", "file",
                                cli_name_json(s->args->moving.path), "window", "from", window.begin, "to", window.end,
                                "motion", all, "contacts", found, "events", s->events, "work", work, "seconds",
                                seconds));
}

static int check(const simulate_args *args) {
    int code = cli_check_ending("animate", args->animate, "svg");
    if (!code) code = cli_check_ending("player", args->player, "html");
    if (code) return code;
    const cli_follow *follow = &args->follow;
    const bool followed = cli_follows(follow);
    static const char partition[] = "It is about the partition, and needs --events or --at.";
    const bool at = !isnan(follow->at), tree = follow->tree.name;
    const cli_need needs[] = {
        {"ghosts", follow->ghosts, followed, partition},
        {"augmented", follow->augmented, followed, partition},
        {"at", at || tree, at && tree, "It needs --output, a file for the tree of that time, and --output needs it."},
        {"places, --unrounded", follow->places || follow->unrounded, tree, "They need --output."},
        {"seconds", !isnan(args->seconds), args->animate || args->player, "It needs --animate or --player."},
    };
    code = cli_check_needs(needs, sizeof needs / sizeof *needs);
    if (code) return code;
    if (!isnan(args->seconds) && !(args->seconds > 0))
        return cli_fail(CLI_USE, NULL, "--seconds: '%g' is not a number above 0.", args->seconds);
    return 0;
}

static int run_simulate(const void *given) {
    const simulate_args *args = given;
    simulation s = {.args = args};
    int code = check(args);
    if (code) return code;
    froe_diagnostic diag;
    code = cli_read_moving(&args->common, &args->moving, cli_follows(&args->follow), &s.motion, &s.read);
    if (code) return code;
    code = cli_check_follow(&args->follow, args->moving.path, s.motion);
    if (!code) code = find_contacts(&s);
    if (!code) code = animate(&s, args->animate); /* before tables: a picture may be refused, and a table cannot be */
    if (!code) code = animate(&s, args->player);
    if (!code && args->contacts) {
        const froe_status status = froe_write_contacts(s.motion, s.contacts, s.count, args->contacts, &diag);
        if (status)
            code = cli_fail_status(CLI_WRITING, args->contacts, status, &diag);
        else
            s.written.names[s.written.count++] = args->contacts;
    }
    cli_follow follow = args->follow;
    follow.deviation = args->moving.deviation, follow.up = s.read.up;
    if (!code) code = cli_follow_motion(&args->common, &follow, args->moving.path, s.motion, &s.events, &s.written);
    for (size_t i = 0; code && i < s.written.count && !args->common.quiet; i++)
        (void)cli_fail(0, s.written.names[i], "note: It was written all the same.");
    if (!code) code = report(&s);
    json_decref(s.events);
    froe_motion_free(s.motion);
    free(s.contacts);
    return code;
}

const cli_command cli_command_simulate = {
    .name = "simulate",
    .summary = "find when moving objects meet, and show it",
    .about =
        "MOVING is a file of OGC Moving Features JSON: lines, polygons and points whose vertices move straight, on "
        "parabolas or on cubics, from instant to instant. All contacts between its segments are found, the shortest "
        "included: "
        "when they begin and end is known to lie between two doubles that are neighbours or nearly so. Segments that "
        "share a vertex are not said to meet. Features with triangles move in space, corner by corner or as bodies "
        "that "
        "fly and turn, and contacts are those of their triangles; pictures of them are those of froe render.\n\n"
        "With --events or --at, a partition (that of the method cylindrical) is kept right while they move: "
        "vertices and crossings that pass over one another, contacts, turns, pieces of flight plans and the like are "
        "its events. In space these are events of the triangles as seen along z; triangles "
        "must not cross, or --ghosts leaves them out meanwhile. In space, corners of bodies fly along parabolas there, "
        "at most "
        "--deviation from where the bodies have them; --json tells how far. A tree is taken at the next odd tick; its "
        "coordinates are doubles, and --json tells how "
        "many "
        "vertices had to be rounded, and whether the cuts are those of the exact places all the same. --places writes "
        "these.\n\n"
        "A model (glTF, FBX, Collada, ...) moves as its animation says: each node that moves is a rigid body. How far "
        "bodies are from the file's own interpolation at most is reported. With --poses, MOVING is a model of "
        "any format, or a plan, and each part that the table names moves.\n\n"
        "Times are those of the file: its numbers, seconds in models, or milliseconds since 1970 for ISO 8601 "
        "instants.",
    .examples = "froe simulate cars.mfjson --contacts contacts.csv\n"
                "froe simulate cars.mfjson --from 301000 --to 305000 --first --json\n"
                "froe simulate cars.mfjson --events events.csv --at 304014.4 -o now.froe\n"
                "froe simulate cars.mfjson --animate cars.svg --player cars.html\n"
                "froe simulate robot.glb --animation wave --contacts contacts.csv\n",
    .parts = parts,
    .defaults =
        &(const simulate_args){
            .common = CLI_COMMON_DEFAULTS, .moving = CLI_MOVING_DEFAULTS, .seconds = NAN, .follow.at = NAN},
    .size = sizeof(simulate_args),
    .run = run_simulate,
};
