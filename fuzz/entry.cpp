// What libFuzzer calls; built once for each reader.

#include "readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    lumel::fuzz::check(lumel::fuzz::LUMEL_FUZZ_READER, {data, size});
    return 0;
}
