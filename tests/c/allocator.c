/* shx_set_allocator: refused without functions, with memory that is not aligned, without memory; then every block comes from the host's functions
 * and goes back to them, aligned and of its size; want of memory is an error; a second allocator is refused. The argument "late" sets it after
 * the first allocation instead. */
#include <stdint.h>
#include "expect.h"
#include <pthread.h>

typedef struct heap {
  pthread_mutex_t lock;
  long blocks, calls;
  size_t bytes, most;
  size_t limit; /* blocks of this size or more are refused; 0: none */
} heap;

/* Before each block: its size and alignment, and what malloc gave. */
typedef struct head {
  size_t size, alignment;
  void *base;
} head;

static void *host_alloc(void *user, size_t size, size_t alignment) {
  heap *h = user;
  if (size == 0 || alignment == 0 || (alignment & (alignment - 1)) != 0)
    abort();
  pthread_mutex_lock(&h->lock);
  h->calls++;
  const int refused = h->limit != 0 && size >= h->limit;
  if (!refused) {
    h->blocks++;
    h->bytes += size;
    if (h->bytes > h->most)
      h->most = h->bytes;
  }
  pthread_mutex_unlock(&h->lock);
  if (refused)
    return NULL;
  char *base = malloc(size + alignment + sizeof(head));
  char *memory = base + sizeof(head);
  memory += (alignment - (uintptr_t)memory % alignment) % alignment;
  const head stated = {size, alignment, base};
  memcpy(memory - sizeof(head), &stated, sizeof stated);
  memset(memory, 0xa5, size);
  return memory;
}

static void host_free(void *user, void *memory, size_t size, size_t alignment) {
  heap *h = user;
  head stated;
  memcpy(&stated, (char *)memory - sizeof(head), sizeof stated);
  if (stated.size != size || stated.alignment != alignment)
    abort();
  pthread_mutex_lock(&h->lock);
  h->blocks--;
  h->bytes -= size;
  pthread_mutex_unlock(&h->lock);
  free(stated.base);
}

static void *crooked_alloc(void *user, size_t size, size_t alignment) {
  return (char *)host_alloc(user, size + 8, alignment) + 8;
}

static void crooked_free(void *user, void *memory, size_t size, size_t alignment) {
  host_free(user, (char *)memory - 8, size + 8, alignment);
}

static heap own = {PTHREAD_MUTEX_INITIALIZER, 0, 0, 0, 0, 0};

static void refused(shx_alloc_fn alloc, shx_free_fn release, shx_result code, const char *because) {
  char text[512];
  EXPECT(shx_set_allocator(alloc, release, &own) == code);
  shx_last_error(text, sizeof text);
  if (strstr(text, because) == NULL) {
    fprintf(stderr, "%s\n", text);
    exit(1);
  }
}

static uint64_t scene_hash(uint32_t workers) {
  shx_solver_def def;
  shx_solver *solver;
  shx_strand_id ids[SCENE_STRANDS];
  EXPECT(shx_solver_def_init(&def, sizeof def) == SHX_OK);
  def.worker_count = workers;
  EXPECT(shx_solver_create(&def, &solver) == SHX_OK);
  add_scene(solver, ids);
  add_obstacles(solver, ids);
  run_scene(solver, ids);
  const uint64_t hash = state_hash(solver);
  shx_solver_destroy(solver);
  return hash;
}

int main(int argc, char **argv) {
  if (argc == 2 && strcmp(argv[1], "late") == 0) {
    printf("%016llx\n", (unsigned long long)scene_hash(1));
    refused(host_alloc, host_free, SHX_ERROR_UNSUPPORTED, "too late");
    EXPECT(own.calls == 0);
    scene_hash(1);
    EXPECT(own.calls == 0);
    return 0;
  }
  refused(NULL, host_free, SHX_ERROR_NULL_ARGUMENT, "alloc is null");
  refused(host_alloc, NULL, SHX_ERROR_NULL_ARGUMENT, "free is null");
  refused(crooked_alloc, crooked_free, SHX_ERROR_INVALID_ARGUMENT, "multiple of 64");
  own.limit = 1;
  refused(host_alloc, host_free, SHX_ERROR_OUT_OF_MEMORY, "returned null");
  own.limit = 0;
  EXPECT(own.blocks == 0);
  EXPECT(shx_set_allocator(host_alloc, host_free, &own) == SHX_OK);
  refused(host_alloc, host_free, SHX_ERROR_UNSUPPORTED, "set already");

  const uint64_t hash = scene_hash(1);
  printf("%016llx\n", (unsigned long long)hash);
  EXPECT(scene_hash(3) == hash);
  EXPECT(own.calls > 500 && own.most > 100000);
  /* What is destroyed goes back; of pools the collector of crossbeam-epoch keeps something. */
  const long blocks = own.blocks;
  const size_t bytes = own.bytes;
  EXPECT(bytes < 65536);
  for (int round = 0; round < 5; round++)
    EXPECT(scene_hash(1) == hash);
  EXPECT(own.blocks == blocks && own.bytes == bytes);
  for (int round = 0; round < 3; round++)
    EXPECT(scene_hash(3) == hash);
  EXPECT(own.bytes < bytes + 65536);

  /* Want of memory. */
  shx_solver *solver;
  EXPECT(shx_solver_create(NULL, &solver) == SHX_OK);
  shx_strand_def strand;
  EXPECT(shx_strand_def_init(&strand, sizeof strand) == SHX_OK);
  strand.length = 0.2;
  strand.element_count = 20000;
  shx_strand_id id;
  own.limit = 1 << 20;
  EXPECT(shx_solver_add_strands(solver, &strand, sizeof strand, 1, &id) == SHX_ERROR_OUT_OF_MEMORY);
  own.limit = 0;
  EXPECT(shx_solver_add_strands(solver, &strand, sizeof strand, 1, &id) == SHX_OK);
  shx_solver_destroy(solver);
  return 0;
}
