#pragma once

/// Before a function in a `..._kernels.cpp`: it is compiled for AVX-512, for AVX2 and for plain
/// x86-64, and the processor that runs it gets its own (GCC's target_clones). What it calls is
/// marked [[gnu::always_inline]], else that stays plain. A sum over vectors of
/// another width differs in its last digits. Where the compiler has no clones, it means nothing.
#ifdef DEIXIS_HAS_TARGET_CLONES
#define DEIXIS_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define DEIXIS_KERNEL
#endif
