// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_tetgen_worker_terminate_h
#define tetradapt_tetgen_worker_terminate_h

namespace tetradapt::tetgen_worker
{
  /** Called with TetGen's error code when TetGen gives up; must not return. */
  using GiveUpHandler = void (*)(int code);

  /** Installs @p handler. Without one, TetGen's code is thrown as an int. */
  void
  set_give_up_handler(GiveUpHandler handler);
} // namespace tetradapt::tetgen_worker

#endif
