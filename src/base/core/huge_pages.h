#pragma once
// Memory in pages of 2 MB.

namespace lumel {

/// Restarts the program, if need be, with an allocator that asks for pages of 2 MB; call it first
/// in main(). Rays land all over hundreds of megabytes: with pages of 4 KB reads miss the TLB, and
/// the first touch of each page is a fault. Linux often grants huge pages only on request, and
/// glibc (2.35) takes that wish from the environment alone, once, as it starts. Returns if pages
/// are as wanted, if GLIBC_TUNABLES is set, or if the system refuses.
void use_huge_pages(char** arguments);

}  // namespace lumel
