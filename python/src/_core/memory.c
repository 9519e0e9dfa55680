/* An array is a window into a block that a capsule owns. The capsule keeps the struct that froe handed out (a
 * froe_answers, say), so that its allocator frees it, whether or not the tree still exists. */
#include "memory.h"
#include "errors.h"
#include <stdlib.h>
#include <string.h>

/* --------------------------------------------------------------- allocation -- */

#ifdef CORE_FAULTS
#include <stdatomic.h>
/* How many allocations still succeed; below 0: all. */
static atomic_long left = -1;

static bool fails(void) {
    if (atomic_load(&left) < 0) return false;
    return atomic_fetch_sub(&left, 1) <= 0 && (atomic_store(&left, 0), true);
}

/* fail_after(count): so many allocations succeed from now on, and all others fail; below 0: none fails */
static PyObject *fail_after(PyObject *module, PyObject *const *args, Py_ssize_t count) {
    (void)module;
    if (!core_arguments("fail_after", count, 1)) return NULL;
    atomic_store(&left, PyLong_AsLong(args[0]));
    Py_RETURN_NONE;
}

static bool add_faults(PyObject *module) {
    static PyMethodDef functions[] = {CORE_METHOD("fail_after", fail_after), {NULL, NULL, 0, NULL}};
    return PyModule_AddFunctions(module, functions) == 0;
}
#else
static bool fails(void) {
    return false;
}

static bool add_faults(PyObject *module) {
    (void)module;
    return true;
}
#endif

static void *allocate(void *user, void *block, size_t old_size, size_t new_size) {
    (void)user, (void)old_size;
    if (!new_size) {
        free(block);
        return NULL;
    }
    return fails() ? NULL : realloc(block, new_size);
}

const froe_allocator core_allocator = {allocate, NULL};

void *core_allocate(size_t count, size_t size) {
    void *memory = count && count > SIZE_MAX / size ? NULL : allocate(NULL, NULL, 0, count * size + !count);
    if (!memory) core_fail(FROE_E_MEMORY, "There is no memory for an array of %zu items.", count);
    return memory;
}

void core_release(void *memory, size_t count, size_t size) {
    allocate(NULL, memory, count * size, 0);
}

/* --------------------------------------------------------------- ownership -- */

typedef struct owned {
    core_free_fn *free_block;
    max_align_t block[];
} owned;

static void free_owned(PyObject *capsule) {
    owned *own = PyCapsule_GetPointer(capsule, NULL);
    own->free_block(own->block);
    free(own);
}

PyObject *core_owner(const void *block, size_t bytes, core_free_fn *free_block) {
    owned *own = allocate(NULL, NULL, 0, sizeof *own + bytes);
    if (!own) {
        core_fail(FROE_E_MEMORY, "There is no memory to hand out an array.");
        void *copy = (void *)block;
        free_block(copy);
        return NULL;
    }
    own->free_block = free_block;
    memcpy(own->block, block, bytes);
    PyObject *capsule = PyCapsule_New(own, NULL, free_owned);
    if (!capsule) {
        own->free_block(own->block);
        free(own);
    }
    return capsule;
}

/* ------------------------------------------------------------------ arrays -- */

typedef struct core_array_object {
    PyObject_HEAD;
    PyObject *owner;
    void *data;
    const char *format;
    int ndim;
    Py_ssize_t item, shape[2], strides[2];
} core_array_object;

static PyTypeObject *array_type;

static size_t item_size(const char *format) {
    return *format == 'B' ? 1 : *format == 'i' ? 4 : 8;
}

static bool is_dense(const core_array_object *array) {
    return array->strides[0] == (array->ndim == 2 ? array->shape[1] : 1) * array->item;
}

static int get_buffer(PyObject *object, Py_buffer *view, int flags) {
    core_array_object *array = (core_array_object *)object;
    view->obj = NULL;
    if (!(flags & PyBUF_STRIDES) && !is_dense(array)) {
        PyErr_SetString(PyExc_BufferError, "The items of this array do not lie one after the other.");
        return -1;
    }
    view->obj = Py_NewRef(object);
    view->buf = array->data;
    view->len = array->shape[0] * (array->ndim == 2 ? array->shape[1] : 1) * array->item;
    view->readonly = 0;
    view->itemsize = array->item;
    view->format = flags & PyBUF_FORMAT ? (char *)array->format : NULL;
    view->ndim = array->ndim;
    view->shape = flags & PyBUF_ND ? array->shape : NULL;
    view->strides = flags & PyBUF_STRIDES ? array->strides : NULL;
    view->suboffsets = NULL;
    view->internal = NULL;
    return 0;
}

static void free_array(PyObject *object) {
    Py_XDECREF(((core_array_object *)object)->owner);
    core_free_object(object);
}

static Py_ssize_t length(PyObject *object) {
    return ((core_array_object *)object)->shape[0];
}

static PyType_Slot array_slots[] = {
    {Py_bf_getbuffer, get_buffer}, {Py_tp_dealloc, free_array}, {Py_sq_length, length}, {0, NULL}};
static PyType_Spec array_spec = {"froe._core.Array", sizeof(core_array_object), 0,
                                 Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, array_slots};

bool core_add_memory(PyObject *module) {
    array_type = core_add_type(module, &array_spec);
    return array_type && add_faults(module);
}

PyObject *core_array(PyObject *owner, const void *data, const char *format, size_t count, size_t width, size_t stride) {
    core_array_object *array = PyObject_New(core_array_object, array_type);
    if (!array) return NULL;
    array->owner = Py_NewRef(owner);
    array->data = (void *)data;
    array->format = format;
    array->item = (Py_ssize_t)item_size(format);
    array->ndim = width ? 2 : 1;
    array->shape[0] = (Py_ssize_t)count;
    array->shape[1] = (Py_ssize_t)width;
    array->strides[0] = stride ? (Py_ssize_t)stride : (Py_ssize_t)(width ? width : 1) * array->item;
    array->strides[1] = array->item;
    return (PyObject *)array;
}

typedef struct plain_block {
    void *memory;
    size_t bytes;
} plain_block;

static void free_plain(void *block) {
    const plain_block *plain = block;
    core_release(plain->memory, plain->bytes, 1);
}

PyObject *core_block(void *memory, size_t bytes) {
    const plain_block block = {memory, bytes};
    return core_owner(&block, sizeof block, free_plain);
}

size_t core_array_bytes(const char *format, size_t count, size_t width) {
    return count * (width ? width : 1) * item_size(format);
}

PyObject *core_array_of(void *memory, const char *format, size_t count, size_t width) {
    PyObject *owner = core_block(memory, core_array_bytes(format, count, width));
    if (!owner) return NULL;
    PyObject *array = core_array(owner, memory, format, count, width, 0);
    Py_DECREF(owner);
    return array;
}

PyObject *core_tuple(size_t count, PyObject *const *objects) {
    bool whole = true;
    for (size_t i = 0; i < count; i++) whole = whole && objects[i];
    PyObject *tuple = whole ? PyTuple_New((Py_ssize_t)count) : NULL;
    for (size_t i = 0; i < count; i++)
        if (tuple)
            PyTuple_SetItem(tuple, (Py_ssize_t)i, objects[i]);
        else
            Py_XDECREF(objects[i]);
    return tuple;
}

/* -------------------------------------------------------------------- piles -- */

bool core_pile_put(void *user, const void *bytes, size_t count) {
    core_pile *pile = user;
    if (count >= pile->room - pile->count) { /* so that there are bytes, even if they are none */
        const size_t room = 2 * pile->room + count + 4096;
        char *grown = allocate(NULL, pile->bytes, pile->room, room);
        pile->full = !grown;
        if (!grown) return false;
        pile->bytes = grown, pile->room = room;
    }
    memcpy(pile->bytes + pile->count, bytes, count);
    pile->count += count;
    return true;
}

void core_pile_free(core_pile *pile) {
    allocate(NULL, pile->bytes, pile->room, 0);
    *pile = (core_pile){0};
}

PyObject *core_pile_owner(core_pile *pile) {
    if (!pile->bytes && !core_pile_put(pile, "", 0))
        return core_fail(FROE_E_MEMORY, "There is no memory for an array.");
    return core_block(pile->bytes, pile->room);
}
