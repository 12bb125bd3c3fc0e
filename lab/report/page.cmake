# The files of the page as string literals of a generated header.

set(scripts dom experiments figures images main numbers papers pixels plot_axes plots report summary tables viewer
    viewer_controls viewer_input)
list(TRANSFORM scripts PREPEND report/page/)
list(TRANSFORM scripts APPEND .js)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
    report/published.json report/page/page.html report/page/page.css ${scripts})
file(READ report/published.json published)
file(READ report/page/page.html page)
file(READ report/page/page.css style)
set(script)
foreach(file IN LISTS scripts)
    file(READ ${file} text)
    string(APPEND script "${text}")
endforeach()
configure_file(report/page_resources.h.in ${PROJECT_BINARY_DIR}/generated/lab/report/page_resources.h @ONLY)
