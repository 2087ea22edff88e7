// How a page looks and what its few controls do. Without script everything is shown.
#pragma once

namespace camdir::report {

extern const char* const style;   // CSS
extern const char* const script;  // JavaScript

}  // namespace camdir::report
