// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_size_field_file_h
#define tetradapt_report_size_field_file_h

#include "tetradapt/adapt/observer.h"

#include <string>

namespace tetradapt::report
{
  /** Writes size_field.vtu after every cycle, whole at any time: the mesh, and as point array
   * "size" the edge length that it has at each point. adapt::SavedSizes reads it. */
  class SizeFieldFile : public adapt::Observer
  {
  public:
    /** @param directory where the file goes; it must exist. */
    explicit SizeFieldFile(const std::string &directory);

    /** A rejected cycle changes nothing.
     * @throws InputError or NumericalError if the file cannot be written. */
    void
    cycle_done(const adapt::CycleEvent &event) override;

  private:
    std::string directory;
  };
} // namespace tetradapt::report

#endif
