// SPDX-License-Identifier: AGPL-3.0-or-later

// TetGen 1.5.0 ends every failure with terminatetetgen(mesh, code). The library's
// own version frees the mesh and throws the code; the mesh's destructor then
// frees it again and the process dies of a segmentation fault, the code lost.
// The symbol is weak and called through the dynamic linker, so the definition
// below takes its place and the code reaches the user. This file must not
// include tetgen.h, which defines the same function inline. Should a build of
// TetGen not look the symbol up, its own version runs as before and the parent
// process reports the crash.

#include "terminate.h"

#include <atomic>

class tetgenmesh;

namespace tetradapt::tetgen_worker
{
  namespace
  {
    std::atomic<GiveUpHandler> give_up_handler{nullptr};
  }

  void
  set_give_up_handler(GiveUpHandler handler)
  {
    give_up_handler = handler;
  }
} // namespace tetradapt::tetgen_worker

__attribute__((visibility("default"))) void
terminatetetgen(tetgenmesh *, int code)
{
  if (const auto handler = tetradapt::tetgen_worker::give_up_handler.load())
    handler(code);
  throw code;
}
