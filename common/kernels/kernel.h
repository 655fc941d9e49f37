#pragma once

/// Before a function in a `..._kernels.cpp`: it is compiled for AVX-512, for AVX2 and for plain
/// x86-64, and the processor that runs it gets its own (GCC's target_clones). What it calls is
/// marked [[gnu::always_inline]], else that stays plain. A sum over vectors of
/// another width differs in its last digits. Where the compiler has no clones, it means nothing.
/// DEIXIS_KERNEL_LEVEL ("arch=x86-64-v3") makes one version only, whatever the processor has: for
/// benchmarks, since neither environment nor GLIBC_TUNABLES make GCC's clones choose another one.
#if defined(DEIXIS_KERNEL_LEVEL)
#define DEIXIS_KERNEL __attribute__((target(DEIXIS_KERNEL_LEVEL)))
#elif defined(DEIXIS_HAS_TARGET_CLONES)
#define DEIXIS_KERNEL __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define DEIXIS_KERNEL
#endif
