#include "reckon/harness/yaml_writer.h"

#include "reckon/harness/describe_scenario.h"
#include "reckon/harness/describe_writer.h"

namespace reckon::harness {

std::string WriteScenario(const Scenario& scenario) {
  Scenario copy = scenario;  // a description serves reading too, so it takes no const
  return EmitYaml(MapWriter::Write(copy));
}

}  // namespace reckon::harness
