// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_mesh_report_h
#define tetradapt_report_mesh_report_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/core/log.h"
#include "tetradapt/report/result_folder.h"

#include <string>
#include <vector>

namespace tetradapt::report
{
  /** mesh.csv: a row a cycle with everything of MeshRecord, the classes of dihedral
   * angles and the totals among it. */
  std::string
  csv_meshes(const std::vector<adapt::CycleRecord> &records);

  /** What was asked for and what came of it, one line, then the shares of the classes of
   * dihedral angles, then the totals; without an end of line. Empty if the record has
   * nothing about its mesh. */
  std::string
  describe_mesh_record(const adapt::CycleRecord &record);

  /** Reports on the mesh of every cycle: to the log, and to mesh.csv, which is whole at
   * any time. */
  class MeshReport : public adapt::Observer
  {
  public:
    /** @param folder where the file goes; null: it is not written. Must outlive the object.
     * @param log must outlive the object. */
    MeshReport(ResultFolder *folder, const core::Log &log);

    void
    run_started(const scene::Scene &scene) override;
    /** @throws InputError or NumericalError if the file cannot be written. */
    void
    cycle_done(const adapt::CycleEvent &event) override;

  private:
    ResultFolder                   *folder;
    const core::Log                &log;
    std::vector<adapt::CycleRecord> records;
  };
} // namespace tetradapt::report

#endif
