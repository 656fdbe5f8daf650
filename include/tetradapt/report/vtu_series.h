// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_vtu_series_h
#define tetradapt_report_vtu_series_h

#include "tetradapt/adapt/observer.h"
#include "tetradapt/report/result_folder.h"

#include <string>
#include <vector>

namespace tetradapt::report
{
  /**
   * Writes what a cycle has computed for ParaView: one cycle_NNN.vtu a cycle, and
   * <scene>.pvd, which lists them and is whole at any time.
   *
   * At nodes: displacement (exactly; read_displacement_vtu() gets it back), REN.
   * In cells: region, surface_patch (see surface_patches()), stress and von_mises (see
   * mean_stresses()), error_indicator. For the file: regions and the boundary, the
   * scene's name, and the figures of the cycle under the names of
   * record_columns(). Except for the displacement, numbers have single precision.
   * What a scene does not have is left out.
   */
  class VtuSeries : public adapt::Observer
  {
  public:
    /**
     * @param folder      where the files go; must outlive the object.
     * @param with_stress whether stresses are computed and written.
     */
    VtuSeries(ResultFolder &folder, bool with_stress);

    /** Begins a new series, named after @p scene. */
    void
    run_started(const scene::Scene &scene) override;

    /** @throws InputError or NumericalError if a file cannot be written. */
    void
    cycle_done(const adapt::CycleEvent &event) override;

  private:
    void
    write_cycle(const adapt::CycleEvent &event, const std::string &path) const;
    void
    write_series() const;

    ResultFolder &folder;
    bool          with_stress;
    std::string   scene_name = "scene";

    struct Entry
    {
      unsigned int cycle;
      std::string  file;
    };
    std::vector<Entry> entries;
  };

  /**
   * For every cell the number of the patch that its boundary face belongs to, the
   * largest one if it has several, -1 for a cell without. Colours the surface of
   * a mesh by its patches.
   */
  std::vector<int>
  surface_patches(const mesh::TetMesh &mesh);
} // namespace tetradapt::report

#endif
