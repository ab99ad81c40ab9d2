# The parts of a report's page, as one C++ source. The viewer is committed as tools/page/build wrote
# it: this needs no node.
set(VKH_PAGE_FOLDER ${PROJECT_SOURCE_DIR}/tools/page)
set(VKH_PAGE_ASSETS ${PROJECT_BINARY_DIR}/generated/page_assets.cpp)
add_custom_command(
  OUTPUT ${VKH_PAGE_ASSETS}
  COMMAND ${Python3_EXECUTABLE} -B ${VKH_PAGE_FOLDER}/embed.py ${VKH_PAGE_FOLDER} ${VKH_PAGE_ASSETS}
  DEPENDS ${VKH_PAGE_FOLDER}/embed.py ${VKH_PAGE_FOLDER}/viewer.js ${VKH_PAGE_FOLDER}/src/page.html ${VKH_PAGE_FOLDER}/src/index.html
          ${VKH_PAGE_FOLDER}/src/index.css ${VKH_PAGE_FOLDER}/src/style.css
  COMMENT "Embedding the report's page"
  VERBATIM)
