// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/cli/load_scene.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/report/output_directory.h"
#include "tetradapt/scene/scene_reader.h"

#include <algorithm>
#include <cctype>

namespace tetradapt::cli
{
  namespace
  {
    /** @p text as a part of a folder's name: other characters than letters, digits, '.', '_'
     * and '-' become one '-'. Long ones are cut; a number in front tells runs apart. */
    std::string
    folder_part(const std::string &text)
    {
      constexpr std::size_t longest = 60;
      std::string           name;
      for (const unsigned char c : text)
        if (c < 128 && (std::isalnum(c) || c == '.' || c == '_'))
          name += char(c);
        else if (!name.empty() && name.back() != '-')
          name += '-';
      name.resize(std::min(name.size(), longest));
      while (!name.empty() && name.back() == '-')
        name.pop_back();
      return name;
    }

    std::string
    numbered(const std::size_t number, const std::size_t n, const std::string &label)
    {
      std::string       text  = std::to_string(number);
      const std::size_t width = std::max<std::size_t>(2, std::to_string(n).size());
      text.insert(0, width - std::min(width, text.size()), '0');
      const std::string part = folder_part(label);
      return part.empty() ? text : text + "-" + part;
    }

    /** The next combination, the last number changing fastest; false after the last. */
    bool
    advance(std::vector<unsigned int>                                &cases,
            const std::vector<tetradapt::scene::VariationParameters> &variations)
    {
      for (std::size_t i = cases.size(); i-- > 0;)
        {
          if (++cases[i] < variations[i].cases.size())
            return true;
          cases[i] = 0;
        }
      return false;
    }
  } // namespace

  scene::Scene
  load_scene(const std::string &file, const Options &options)
  {
    scene::Mistakes mistakes;
    scene::Scene    scene = scene::read_scene(file, options.settings, mistakes);
    if (!options.output_directory.empty())
      {
        scene.output.directory = options.output_directory;
        if (options.scenes.size() > 1)
          scene.output.directory += "/" + scene.name;
        scene.places["Output/Directory"] = "command line";
        scene::Mistakes found;
        found.attempt([&]() { scene.output.check(); });
        mistakes.merge(found, [&](const auto &message) { return scene.with_place(message); });
      }
    mistakes.throw_if_any(file);
    return scene;
  }

  std::string
  case_label(const scene::VariationParameters &variation, const unsigned int number)
  {
    if (!variation.labels.empty())
      return variation.labels[number];
    std::string label = variation.name;
    for (const std::string &value : variation.cases[number])
      label += " " + value;
    return label;
  }

  std::vector<StudyRun>
  load_study(const scene::Scene &study, const Options &options)
  {
    std::size_t n_runs = 1;
    for (const auto &variation : study.variations)
      n_runs *= variation.cases.size();
    const std::string         directory = report::OutputDirectory::path_of(study);
    std::vector<unsigned int> cases(study.variations.size(), 0);
    std::vector<StudyRun>     runs;
    scene::Mistakes           mistakes;
    do
      {
        StudyRun run;
        run.cases = cases;
        for (std::size_t i = 0; i < cases.size(); ++i)
          run.label += (i == 0 ? "" : ", ") + case_label(study.variations[i], cases[i]);
        run.name = numbered(runs.size() + 1, n_runs, run.label);
        scene::Mistakes found;
        run.scene = scene::read_study_run(study.file, options.settings, cases, found);
        mistakes.merge(found);
        run.scene.output.directory = directory + "/" + run.name;
        run.scene.title = (study.title.empty() ? study.name : study.title) + ": " + run.label;
        runs.push_back(std::move(run));
    } while (advance(cases, study.variations));
    mistakes.throw_if_any(study.file);
    return runs;
  }
} // namespace tetradapt::cli
