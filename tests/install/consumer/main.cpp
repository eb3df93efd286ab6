// Uses the installed library for what a host does first, and fails if it does not answer.
#include <iostream>

#include "runtime/diagnostic.h"
#include "runtime/type.h"

int main() {
  nacre::Diagnostics diagnostics;
  diagnostics.error("unknown-node", {"wood.mtlx", 12, 3, "NG_wood/mix1"}, "no such node", "mix",
                    "mxi");
  if (!diagnostics.has_errors() || nacre::parse_type("color3") != nacre::Type::color3) return 1;
  std::cout << diagnostics.to_string() << '\n';
  return 0;
}
