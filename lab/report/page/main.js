// Builds the page. Nothing of the other files runs before, so that their order does not matter.

function showReport() {
    const page = document.getElementById("page");
    const state = document.documentElement.dataset;
    try {
        const report = readReport(document.getElementById("report").textContent);
        document.title = report.title;
        page.replaceChildren(
            element("header", { class: "top" }, element("h1", {}, report.title),
                element("p", { class: "source" }, report.generated ? `Generated ${formatDate(report.generated)}` : "",
                    button("Print", { class: "print", title: "Decodes all images first" }, printAll))),
            contentsNode(report),
            element("main", { id: "content", tabindex: -1 },
                summaryNode(report), papersNode(report), experimentsNode(report), notRunNode(report)));
        // The browser looked for the target of the address before it was there.
        if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();
        // A frame is painted between the first call and the second.
        requestAnimationFrame(() => requestAnimationFrame(() => { state.state = "ready"; }));
    } catch (error) {
        page.replaceChildren(element("main", { id: "content" }, element("h1", {}, "This report is damaged"),
            element("p", { class: "failure", role: "alert" }, `Its data cannot be read: ${error.message}`)));
        state.state = "failed";
    }
}

document.addEventListener("DOMContentLoaded", showReport);
