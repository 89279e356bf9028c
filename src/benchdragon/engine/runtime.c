/* All that numba's code wants of its runtime: blocks of memory that are counted, and freed at zero.

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
