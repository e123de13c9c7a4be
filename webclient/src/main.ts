/** Opens the page. */
import "./style.css";
import { Api, ApiError } from "./api";
import { start } from "./app/startup";
import { CapabilityError } from "./gl/capabilities";
import { byId } from "./ui/dom";
import { LoadingScreen } from "./ui/loading";

const loadingScreen = new LoadingScreen(byId("loading"));

try {
  await start(new Api(), loadingScreen);
} catch (error) {
  if (error instanceof CapabilityError) {
    loadingScreen.fail("Graphics feature missing", `${error.message} Use a current version of Chrome, Edge, Firefox or Safari.`, null);
  } else if (error instanceof ApiError) {
    loadingScreen.fail(error.status === 0 ? "Server not reachable" : "Server error", error.message, "Reload page");
  } else {
    loadingScreen.fail("Unexpected error", error instanceof Error ? error.message : String(error), "Reload page");
    throw error;
  }
}
