# Compiler flags, the same for every target. Debian's FCL is built with 16-byte Eigen alignment: no -march flags here,
# or types that cross that border would change their layout.
add_library(genu_options INTERFACE)
target_compile_options(genu_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
                       -Woverloaded-virtual -Werror
                       -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
# The last four: GCC 12 warns falsely of std::string (GCC bug 105651) where headers are read once for all.
target_compile_definitions(genu_options INTERFACE EIGEN_MAX_ALIGN_BYTES=16)
# No fused or reordered floating point: the same input gives the same bytes.
target_compile_options(genu_options INTERFACE -ffp-contract=off)
if(GENU_SANITIZE)
  # Left out of `undefined`: what the address sanitizer or the processor stops at anyway, a third of the time to build.
  target_compile_options(genu_options INTERFACE -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
                         -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(genu_options INTERFACE -fsanitize=address,undefined)
endif()
