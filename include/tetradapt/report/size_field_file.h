// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_size_field_file_h
#define tetradapt_report_size_field_file_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/report/result_folder.h"

#include <string>

namespace tetradapt::report
{
  /** Writes size_field.vtu after every cycle, whole at any time: the mesh, and as point array
   * "size" the edge length that it has at each point. adapt::SavedSizes reads it. */
  class SizeFieldFile : public adapt::Observer
  {
  public:
    /** @param folder where the file goes; must outlive the object. */
    explicit SizeFieldFile(ResultFolder &folder);

    /** A rejected cycle changes nothing.
     * @throws InputError or NumericalError if the file cannot be written. */
    void
    cycle_done(const adapt::CycleEvent &event) override;

  private:
    ResultFolder &folder;
  };
} // namespace tetradapt::report

#endif
