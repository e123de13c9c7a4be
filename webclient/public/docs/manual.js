// Shows the API reference. `validatorUrl` is null, because the default is a service elsewhere.
{
  const manual = document.getElementById("manual");
  SwaggerUIBundle({
    domNode: manual,
    url: manual.dataset.description,
    layout: "BaseLayout",
    deepLinking: true,
    showExtensions: true,
    showCommonExtensions: true,
    validatorUrl: null,
    presets: [SwaggerUIBundle.presets.apis],
  });
}
