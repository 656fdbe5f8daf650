// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/report/size_field_file.h"

#include "tetradapt/io/vtu_writer.h"

namespace tetradapt::report
{
  SizeFieldFile::SizeFieldFile(ResultFolder &folder) : folder(folder)
  {
  }

  void
  SizeFieldFile::cycle_done(const adapt::CycleEvent &event)
  {
    if (event.node_sizes == nullptr || event.record.acceptance == adapt::Acceptance::rejected)
      return;
    io::VtuWriter writer(event.mesh);
    writer.add_point_data("size", 1, *event.node_sizes);
    writer.add_regions();
    writer.write(folder.prepare("size_field.vtu"));
  }
} // namespace tetradapt::report
