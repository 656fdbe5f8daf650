// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/application.h"

int
main(int argc, char **argv)
{
  return tetradapt::cli::run_application(argc, argv);
}
