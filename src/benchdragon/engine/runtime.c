/* What numba's code wants of its runtime: blocks of memory that are counted, and freed at zero. Below
that, what kernels/memory.py asks for, which outlives a call.

The first field must be the count and the fourth the data: numba's code reads and writes them. Counts
and sizes have 64 bits there whatever the target, pointers as many as the target's. */
#include <stdint.h>
#include <stdlib.h>

#define HIDDEN __attribute__((visibility("hidden")))

typedef struct {
    uint64_t count;
    void *destructor, *context, *data;
    uint64_t size;
    void *allocator;
} Memory;

HIDDEN void *NRT_MemInfo_alloc_aligned(uint64_t size, uint32_t align) {
    if (size > SIZE_MAX / 2) return NULL;
    Memory *memory = malloc(sizeof(Memory) + size + align);
    if (memory == NULL) return NULL;
    uintptr_t start = (uintptr_t)(memory + 1);
    memory->count = 1;
    memory->destructor = memory->context = memory->allocator = NULL;
    memory->data = (void *)(start + (align - start % align) % align);
    memory->size = size;
    return memory;
}

HIDDEN void NRT_MemInfo_call_dtor(Memory *memory) { free(memory); }

/* Memory of questions under way: how much there is, and their handles. Several threads may ask at once.

A handle is a number of a question that was never given before, times LIVE, plus its place in `live`. */
#define LIVE 1024
#define BEFORE 16 /* bytes in front of what is allocated: its size, and what keeps it aligned */

static int64_t held, asked;
static struct {
    int64_t handle, address;
} live[LIVE];

HIDDEN int64_t bd_allocate(int64_t size) {
    if (size < 0 || (uint64_t)size > SIZE_MAX / 2) return 0;
    char *memory = malloc(BEFORE + size);
    if (memory == NULL) return 0;
    *(int64_t *)memory = size;
    __atomic_fetch_add(&held, size, __ATOMIC_RELAXED);
    return (int64_t)(intptr_t)(memory + BEFORE);
}

HIDDEN int64_t bd_release(int64_t address) {
    if (address == 0) return 0;
    char *memory = (char *)(intptr_t)address - BEFORE;
    __atomic_fetch_sub(&held, *(int64_t *)memory, __ATOMIC_RELAXED);
    free(memory);
    return 0;
}

HIDDEN int64_t bd_taken(void) { return __atomic_load_n(&held, __ATOMIC_RELAXED); }

HIDDEN int64_t bd_remember(int64_t address) {
    int64_t handle = __atomic_add_fetch(&asked, 1, __ATOMIC_RELAXED) * LIVE;
    for (int place = 0; place < LIVE; place++) {
        int64_t none = 0;
        if (!__atomic_compare_exchange_n(&live[place].handle, &none, -1, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED))
            continue;
        live[place].address = address;
        __atomic_store_n(&live[place].handle, handle + place, __ATOMIC_RELEASE);
        return handle + place;
    }
    return 0;
}

HIDDEN int64_t bd_recall(int64_t handle) {
    if (handle <= 0) return 0;
    int64_t known = __atomic_load_n(&live[handle % LIVE].handle, __ATOMIC_ACQUIRE);
    return known == handle ? live[handle % LIVE].address : 0;
}

HIDDEN int64_t bd_forget(int64_t handle) {
    int64_t address = bd_recall(handle), known = handle;
    if (address == 0) return 0;
    int done = __atomic_compare_exchange_n(&live[handle % LIVE].handle, &known, 0, 0, __ATOMIC_ACQ_REL, __ATOMIC_RELAXED);
    return done ? address : 0;
}
