#include "reports/report.hpp"

#include <memory>

#include "core/io/atomic_output.hpp"
#include "core/io/hdf5_file.hpp"
#include "reports/contents.hpp"
#include "reports/junit.hpp"
#include "reports/origin.hpp"
#include "reports/page.hpp"
#include "reports/summary_json.hpp"

namespace xpr {
namespace {

// A directory that holds this file is an earlier report, and may be replaced.
constexpr const char* marker = "report.h5";

void write_h5(const ReportInputs& inputs, const Hashes& found, const std::filesystem::path& path) {
  Hdf5File file = Hdf5File::create(path);
  file.set_attribute("/", "schema", "xprimeray-report");
  file.set_attribute("/", "schema_version", report_schema_version);
  file.set_attribute("/", "suite", inputs.suite.suite);
  write_datasets(file, result_datasets(inputs.suite));
  write_origin(file, {inputs.provenance,
                      inputs.command,
                      inputs.configuration,
                      {{"report_hash", found.report}, {"rays_hash", found.rays}}});
  for (const auto& [name, text] : inputs.circumstances) file.set_attribute("/volatile", name, text);
  write_datasets(file, timing_datasets(inputs.suite));
  file.close();
}

std::string laid_out(const Contents& contents, std::unique_ptr<Page> page) {
  compose(contents, *page);
  return page->finish();
}

}  // namespace

void check_report_directory(const std::filesystem::path& directory) { const AtomicDirectory probe(directory, marker); }

ReportOutcome write_report(const ReportInputs& inputs, const std::filesystem::path& directory) {
  AtomicDirectory out(directory, marker);
  const Digest summary = digest(inputs.suite);
  Contents contents{.suite = inputs.suite,
                    .digest = summary,
                    .coverage = coverage(inputs.suite, inputs.charts, inputs.methods),
                    .figures = {},
                    .hashes = hashes(inputs.suite),
                    .command = inputs.command,
                    .configuration = configuration_text(inputs.configuration),
                    .provenance = provenance_facts(inputs.provenance)};
  for (const Facts& changing : {volatile_facts(inputs.provenance), inputs.circumstances}) {
    contents.provenance.insert(contents.provenance.end(), changing.begin(), changing.end());
  }
  write_h5(inputs, contents.hashes, out.path() / "report.h5");
  contents.figures = draw_figures(inputs.figure_tools, out.path());
  write_file(out.path() / "report.md", laid_out(contents, make_markdown_page()));
  write_file(out.path() / "report.html", laid_out(contents, make_html_page()));
  write_file(out.path() / "junit.xml", junit_xml(inputs.suite));
  write_file(out.path() / "summary.json", summary_json(contents));
  out.commit();
  return {contents.hashes, contents.figures.problems};
}

}  // namespace xpr
