// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_scene_scene_sink_h
#define tetradapt_scene_scene_sink_h

#include "declarations.h"
#include "prm_lines.h"

#include <filesystem>

namespace tetradapt::scene
{
  /** Fills a ParameterHandler and a scene's blocks from what a file says. Values that do not fit
   * are added to the mistakes; names that do not exist are thrown, as PrmSink has it. */
  class SceneSink : public PrmSink
  {
  public:
    /** Keeps references. */
    SceneSink(Scene &scene, dealii::ParameterHandler &prm, Mistakes &mistakes);

    void
    enter(const SectionPath &path, const Place &place) override;

    void
    set(const SectionPath &path,
        const std::string &name,
        const std::string &value,
        const Place       &place) override;

    /** Sets a "Section/Name=value" of the command line. @throws core::InputError */
    void
    set_override(const std::string &text);

    /** Sets what @p variation varies to the values of its case @p number, as if they
     * were written in the file where its Values are. @throws core::InputError */
    void
    set_case(const VariationParameters &variation, unsigned int number);

    /** The folder that relative names of files in @p parameter count from. */
    std::filesystem::path
    folder_of(const std::string &parameter) const;

  private:
    /** Whether @p value fits the parameter. */
    bool
    try_to_set(const SectionPath &path, const std::string &name, const std::string &value);

    /** @throws InputError if @p path is not that of a parameter in a section that the
     * file has. */
    void
    check_name(SectionPath path, const Place &place);

    /** Sets the parameter whose section and name @p path holds; its section must be in
     * the file. */
    void
    set_existing(SectionPath path, const std::string &value, const Place &place);

    /** The declared section at @p path, whose names have been checked. */
    const SectionTree *
    find(const SectionPath &path) const;

    /** @throws InputError if the file has no section or block @p path. */
    void
    find_existing(const SectionPath &path, const Place &place);

    void
    enter_block(const SectionPath &path, const Place &place);

    [[noreturn]] void
    refuse_section(const SectionTree &parent, const SectionPath &path, const Place &place);

    [[noreturn]] void
    refuse_entry(const SectionTree &section,
                 const SectionPath &path,
                 const std::string &name,
                 const Place       &place) const;

    Scene                              &scene;
    dealii::ParameterHandler           &prm;
    Mistakes                           &mistakes;
    SectionTree                         valid;
    std::map<std::string, unsigned int> lines; ///< of "file\nparameter"
    std::map<std::string, Place>        places_of_values;
    std::map<std::string, std::string>  owners; ///< variation of each parameter that varies
  };
} // namespace tetradapt::scene

#endif
