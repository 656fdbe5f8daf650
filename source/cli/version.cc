// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/options.h"

#include <deal.II/base/config.h>

#include <CGAL/version.h>
#include <Trilinos_version.h>

namespace tetradapt::cli
{
  std::string
  version_text()
  {
#ifdef DEBUG
    const std::string build_type = "Debug";
#else
    const std::string build_type = "Release";
#endif
    return "tetradapt " TETRADAPT_VERSION "\n"
           "deal.II   " DEAL_II_PACKAGE_VERSION "\n"
           "Trilinos  " TRILINOS_VERSION_STRING "\n"
           "TetGen    " TETRADAPT_TETGEN_VERSION "\n"
           "CGAL      " CGAL_VERSION_STR "\n"
           "compiler  "
#ifdef __clang__
           "Clang " __clang_version__
#else
           "GCC " __VERSION__
#endif
           ", "
           + build_type + "\n";
  }
} // namespace tetradapt::cli
