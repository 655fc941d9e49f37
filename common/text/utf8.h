#pragma once
#include <string_view>

namespace deixis::text {

/// True when `text` is as LCM's strings carry it: UTF-8 (RFC 3629: shortest form, no surrogates)
/// without NUL.
bool IsUtf8(std::string_view text);

}  // namespace deixis::text
