// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_report_gnuplot_h
#define tetradapt_report_gnuplot_h

#include "tetradapt/core/log.h"
#include "tetradapt/report/result_folder.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

/** Pictures by gnuplot, which is a program of its own and may be missing. */
namespace tetradapt::report
{
  /** Colours that PlotCurve::colour can tell apart; a larger number starts again. */
  constexpr unsigned int n_plot_colours = 8;

  /** A curve of a LinePlot. */
  struct PlotCurve
  {
    std::string                        label;
    std::vector<std::array<double, 2>> points;
    unsigned int                       colour  = 0;     ///< curves of one number have one colour
    unsigned int                       pattern = 0;     ///< ... one kind of line and point
    bool                               steps   = false; ///< a histogram's outline
  };

  /** What theory says of the slope of a logarithmic plot, drawn as a triangle. */
  struct PlotSlope
  {
    double      exponent = -1.; ///< negative
    std::string label;          ///< gnuplot's enhanced text: "N^{-1/3}"
  };

  /** Curves over a plane. Points that a logarithmic axis cannot show, and those that are
   * not finite, are left out. */
  struct LinePlot
  {
    std::string            title, x_label, y_label;
    bool                   logarithmic_x = false, logarithmic_y = false;
    bool                   whole_x = false; ///< ticks at whole numbers only
    std::vector<PlotCurve> curves;
    std::vector<PlotSlope> slopes;      ///< on two logarithmic axes only
    std::optional<double>  level;       ///< a horizontal line that curves should meet
    std::string            explanation; ///< small, below; may be empty
    std::string            key;         ///< above the names of the curves; may be empty
  };

  /** Groups of bars: for each class one bar a series. */
  struct BarPlot
  {
    std::string              title, x_label, y_label;
    std::vector<std::string> classes;
    struct Series
    {
      std::string         label;
      std::vector<double> values; ///< one a class
    };
    std::vector<Series> series;
  };

  /** @p text as a constant of a gnuplot script, taken literally whatever is in it. */
  std::string
  gnuplot_text(const std::string &text);

  /** A script, data included, that makes gnuplot write the picture as SVG to its standard
   * output; empty if there is nothing to show. */
  std::string
  gnuplot_script(const LinePlot &plot);
  std::string
  gnuplot_script(const BarPlot &plot);

  /** Where gnuplot is on this machine, by the environment variable PATH; empty: nowhere. */
  std::string
  find_gnuplot();

  /**
   * Writes pictures, <name>.svg, and next to each the script <name>.gp that it was made by,
   * into the folder "plots" of a folder of results. One gnuplot draws all pictures, since its
   * start takes longer than a picture. Without gnuplot there are only scripts, and the log
   * says so once; that a picture fails is a warning, never the end of a run.
   */
  class PictureFolder
  {
  public:
    /** Both arguments must outlive the object. */
    PictureFolder(ResultFolder &folder, const core::Log &log);

    /** Writes the script; the picture is drawn by draw(). Nothing for an empty script.
     * @throws InputError or NumericalError if a file cannot be written. */
    void
    add(const std::string &name, const std::string &script);

    /** Draws what was added since the last call; starts no gnuplot if that is nothing.
     * @throws as add(). */
    void
    draw();

  private:
    struct Picture
    {
      std::string name, script;
    };

    /** Draws @p pictures with one gnuplot; returns what went wrong, if something did:
     * ": " and a message, or the time that it took. */
    std::optional<std::string>
    draw(const std::vector<Picture> &pictures) const;

    ResultFolder        &folder;
    const core::Log     &log;
    std::string          program;
    std::vector<Picture> waiting;
    bool                 missing_was_said = false;
  };
} // namespace tetradapt::report

#endif
