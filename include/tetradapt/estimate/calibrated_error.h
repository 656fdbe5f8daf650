// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_calibrated_error_h
#define tetradapt_estimate_calibrated_error_h

#include <optional>
#include <vector>

namespace tetradapt::estimate
{
  /** The solution on one mesh of a sequence, each a refinement of the one before. */
  struct NestedSolution
  {
    double n_dofs = 0.;
    /** 2 F(u_h) - a(u_h,u_h): it rises to that of the solution u, and what is missing
     * is the square of the error's energy norm. */
    double gain = 0.;
    /** An indicator of the error's energy norm: proportional to it, more or less. */
    double indicator = 0.;
  };

  /**
   * The energy norm of the error on the last of several nested meshes. What refinement
   * gained is the decrease of the error's square, exactly; that divided by the decrease
   * of the indicator's square tells what the indicator must be multiplied by. Of the
   * factors over the last one to five steps the largest is taken. The result is not
   * larger than what these steps leave if the error falls like N^-0.25 only.
   *
   * @return empty for fewer than three levels, or if nothing was gained.
   */
  std::optional<double>
  calibrated_error(const std::vector<NestedSolution> &levels);
} // namespace tetradapt::estimate

#endif
