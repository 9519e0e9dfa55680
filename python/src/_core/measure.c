/* measure.c: measures of a scene, as dictionaries whose keys are the fields of the classes in src/froe/measure.py. */
#include "call.h"
#include "errors.h"
#include "memory.h"
#include "scene.h"
#include <froe/measure.h>

/* A measure in progress: the last four arguments are samples, seed, threads and progress. */
typedef struct measuring {
    core_scene *self;
    const froe_scene *scene;
    froe_measure_options options;
    unsigned threads;
    PyObject *progress;
    core_call call;
} measuring;

static bool begin(measuring *m, PyObject *self, const char *name, PyObject *const *args, Py_ssize_t given,
                  Py_ssize_t wanted) {
    m->options = froe_measure_defaults();
    if (!core_arguments(name, given, wanted) ||
        !core_unsigned(args[wanted - 4], "samples", UINT32_MAX, &m->options.samples) ||
        !core_long(args[wanted - 3], "seed", &m->options.seed) ||
        !core_unsigned(args[wanted - 2], "threads", UINT32_MAX, &m->threads))
        return false;
    m->self = (core_scene *)self;
    m->progress = args[wanted - 1];
    m->scene = core_scene_take(m->self);
    return m->scene;
}

static void run(measuring *m) {
    core_call_begin(&m->call, m->progress);
    m->options.progress = core_call_progress;
    m->options.user = &m->call;
}

static bool end(measuring *m, froe_status status) {
    const bool done = core_call_end(&m->call, status);
    core_scene_give(m->self);
    return done;
}

static PyObject *spread(const froe_spread *s) {
    return Py_BuildValue("(Kdddddddd)", (unsigned long long)s->count, s->least, s->q05, s->q25, s->median, s->q75,
                         s->q95, s->most, s->mean);
}

static PyObject *point(const double *x, int dim) {
    PyObject *tuple = PyTuple_New(dim);
    for (int k = 0; tuple && k < dim; k++) PyTuple_SetItem(tuple, k, PyFloat_FromDouble(x[k]));
    return tuple;
}

/* defects(samples, seed, threads, progress) */
PyObject *core_measure_defects(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    measuring m;
    froe_defects d = {.size = sizeof d};
    if (!begin(&m, self, "defects", args, count, 4)) return NULL;
    run(&m);
    if (!end(&m, froe_scene_defects(m.scene, m.threads, core_call_progress, &m.call, &d, &m.call.diag))) return NULL;
    return Py_BuildValue("{s:K,s:K,s:K,s:K,s:K,s:K}", "zero_length", (unsigned long long)d.zero_length, "zero_area",
                         (unsigned long long)d.zero_area, "duplicates", (unsigned long long)d.duplicates, "crossings",
                         (unsigned long long)d.crossings, "t_junctions", (unsigned long long)d.t_junctions, "overlaps",
                         (unsigned long long)d.overlaps);
}

/* fatness(samples, seed, threads, progress) */
PyObject *core_measure_fatness(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    measuring m;
    froe_fatness f;
    if (!begin(&m, self, "fatness", args, count, 4)) return NULL;
    run(&m);
    if (!end(&m, froe_measure_fatness(m.scene, &m.options, &f, &m.call.diag))) return NULL;
    return Py_BuildValue("{s:N,s:N,s:N,s:K}", "full", spread(&f.full), "flat", spread(&f.flat), "sliver",
                         spread(&f.sliver), "thin", (unsigned long long)f.thin);
}

/* density(by diameter, samples, seed, threads, progress) */
PyObject *core_measure_density(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    measuring m;
    froe_density d;
    bool diameter;
    if ((count && !core_flag(args[0], &diameter)) || !begin(&m, self, "density", args, count, 5)) return NULL;
    const froe_size size = diameter ? FROE_SIZE_DIAMETER : FROE_SIZE_RADIUS;
    run(&m);
    if (!end(&m, froe_measure_density(m.scene, size, &m.options, &d, &m.call.diag))) return NULL;
    return Py_BuildValue("{s:I,s:I,s:K,s:N,s:d,s:N}", "lower", (unsigned)d.lower, "upper", (unsigned)d.upper, "count",
                         (unsigned long long)d.count, "centre", point(d.centre, froe_scene_dim(m.scene)), "radius",
                         d.radius, "load", spread(&d.load));
}

/* clutter(samples, seed, threads, progress) */
PyObject *core_measure_clutter(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    measuring m;
    froe_clutter c;
    if (!begin(&m, self, "clutter", args, count, 4)) return NULL;
    run(&m);
    if (!end(&m, froe_measure_clutter(m.scene, &m.options, &c, &m.call.diag))) return NULL;
    const int dim = froe_scene_dim(m.scene);
    return Py_BuildValue("{s:I,s:N,s:N,s:K,s:N}", "lower", (unsigned)c.lower, "lo", point(c.lo, dim), "hi",
                         point(c.hi, dim), "count", (unsigned long long)c.count, "load", spread(&c.load));
}

/* directional(delta, samples, seed, threads, progress) */
PyObject *core_measure_directional(PyObject *self, PyObject *const *args, Py_ssize_t count) {
    measuring m;
    froe_directional d;
    double delta = 0;
    if ((count && !core_double(args[0], "delta", &delta)) || !begin(&m, self, "directional", args, count, 5))
        return NULL;
    run(&m);
    if (!end(&m, froe_measure_directional(m.scene, delta, &m.options, &d, &m.call.diag))) return NULL;
    return Py_BuildValue("{s:d,s:K,s:N,s:N,s:N,s:N}", "delta", d.delta, "count", (unsigned long long)d.count, "simple",
                         spread(&d.simple), "extended", spread(&d.extended), "two_directional",
                         spread(&d.two_directional), "paired", spread(&d.paired));
}
