// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/core/stage_timer.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace tetradapt::core
{
  namespace
  {
    double
    cpu_seconds(const int who)
    {
      rusage usage{};
      ::getrusage(who, &usage);
      return usage.ru_utime.tv_sec + usage.ru_stime.tv_sec
             + 1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    }
  } // namespace

  StageTimer::Scope::Scope(StageTimer &timer, const std::string &stage) : timer(timer)
  {
    timer.charge();
    timer.open.push_back(timer.row_number(stage));
    ++timer.finished[timer.open.back()].calls;
  }

  StageTimer::Scope::~Scope()
  {
    timer.charge();
    timer.open.pop_back();
  }

  StageTimer::StageTimer() : last(now()), finished(1)
  {
    finished[0].stage = "other";
  }

  StageTimer::Scope
  StageTimer::scope(const std::string &stage)
  {
    return Scope(*this, stage);
  }

  StageTimer::Clocks
  StageTimer::now()
  {
    const auto wall = std::chrono::steady_clock::now().time_since_epoch();
    return {std::chrono::duration<double>(wall).count(),
            cpu_seconds(RUSAGE_SELF) + cpu_seconds(RUSAGE_CHILDREN)};
  }

  void
  StageTimer::charge()
  {
    const Clocks time = now();
    Row         &row  = finished[open.empty() ? 0 : open.back()];
    row.wall += time.wall - last.wall;
    row.cpu += time.cpu - last.cpu;
    last = time;
  }

  unsigned int
  StageTimer::row_number(const std::string &stage)
  {
    for (unsigned int i = 0; i < finished.size(); ++i)
      if (finished[i].stage == stage)
        return i;
    finished.emplace_back();
    finished.back().stage = stage;
    return finished.size() - 1;
  }

  std::vector<StageTimer::Row>
  StageTimer::rows() const
  {
    StageTimer copy(*this);
    copy.charge();
    std::rotate(copy.finished.begin(), copy.finished.begin() + 1, copy.finished.end());
    return copy.finished;
  }

  double
  StageTimer::wall(const std::string &stage) const
  {
    for (const Row &row : rows())
      if (row.stage == stage)
        return row.wall;
    return 0.;
  }

  double
  StageTimer::cpu(const std::string &stage) const
  {
    for (const Row &row : rows())
      if (row.stage == stage)
        return row.cpu;
    return 0.;
  }

  double
  StageTimer::total_wall() const
  {
    double sum = 0.;
    for (const Row &row : rows())
      sum += row.wall;
    return sum;
  }

  double
  StageTimer::total_cpu() const
  {
    double sum = 0.;
    for (const Row &row : rows())
      sum += row.cpu;
    return sum;
  }

  std::string
  StageTimer::table() const
  {
    const std::vector<Row> all = rows();

    Row         total;
    std::size_t width = 5;
    for (const Row &row : all)
      {
        total.wall += row.wall;
        total.cpu += row.cpu;
        width = std::max(width, row.stage.size());
      }
    total.stage = "total";

    char        line[256];
    std::string text;
    const auto  add = [&](const Row &row, const std::string &calls) {
      std::snprintf(line,
                    sizeof line,
                    "%-*.80s %7s %10.3f %10.3f %6.1f%%\n",
                    static_cast<int>(std::min<std::size_t>(width, 80)),
                    row.stage.c_str(),
                    calls.c_str(),
                    row.wall,
                    row.cpu,
                    total.wall > 0. ? 100. * row.wall / total.wall : 0.);
      text += line;
    };
    std::snprintf(line,
                  sizeof line,
                  "%-*s %7s %10s %10s %7s\n",
                  static_cast<int>(std::min<std::size_t>(width, 80)),
                  "stage",
                  "calls",
                  "wall s",
                  "CPU s",
                  "share");
    text += line;
    for (const Row &row : all)
      add(row, row.calls > 0 ? std::to_string(row.calls) : "");
    add(total, "");
    return text;
  }
} // namespace tetradapt::core
