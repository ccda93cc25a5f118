#include "volume/vtk_errors.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>

#include <fstream>

#include "files/failure.h"

namespace isostar::native {

bool updateQuietly(vtkAlgorithm& reader) {
  bool failed = false;
  const vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&failed);
  observer->SetCallback(
      [](vtkObject*, unsigned long, void* data, void*) { *static_cast<bool*>(data) = true; });
  vtkOutputWindow& window = *vtkOutputWindow::GetInstance();
  window.AddObserver(vtkCommand::ErrorEvent, observer);
  window.AddObserver(vtkCommand::WarningEvent, observer);
  reader.Update();
  window.RemoveObserver(observer);
  return !failed && reader.GetErrorCode() == 0;
}

void refuseEntities(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(65536, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<size_t>(file.gcount()));
  if (head.find("<!DOCTYPE") != std::string::npos || head.find("<!ENTITY") != std::string::npos)
    throw Failure(path, "has a DOCTYPE or an ENTITY, which is not allowed in VTK files");
}

}  // namespace isostar::native
