#pragma once
#include "common/messages/codec.h"

namespace deixis::messages {

/// True when `bytes` are text as LCM's strings carry it: UTF-8 (RFC 3629: shortest form, no
/// surrogates) without NUL.
bool IsText(Bytes bytes);

}  // namespace deixis::messages
