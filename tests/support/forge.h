/* forge.h: tree files with wrong contents and right checksums. */
#ifndef FROE_TESTS_SUPPORT_FORGE_H
#define FROE_TESTS_SUPPORT_FORGE_H
#include "tree/file.h"

/** Makes the checksums of a tree file right again, as far as its table can be followed. */
static inline void forge_checksums(uint8_t *bytes, size_t size) {
    file_header h;
    file_section s;
    const size_t table = FILE_SECTIONS * sizeof s;
    if (size < sizeof h + table) return;
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        memcpy(&s, bytes + sizeof h + i * sizeof s, sizeof s);
        if (s.offset > size || s.size > size - s.offset) continue;
        s.checksum = file_checksum(bytes + s.offset, s.size, 0);
        memcpy(bytes + sizeof h + i * sizeof s, &s, sizeof s);
    }
    memcpy(&h, bytes, sizeof h);
    h.checksum = file_checksum(bytes + sizeof h, table, file_checksum(bytes, offsetof(file_header, checksum), 0));
    memcpy(bytes, &h, sizeof h);
}
#endif
