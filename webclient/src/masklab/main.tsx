/** Opens the mask laboratory, a page of its own. */
import "../style.css";
import { render } from "preact";
import { Api, messageOf } from "../api";
import { byId } from "../ui/dom";
import { Lab } from "./lab";

const base = new URL("..", document.baseURI).href;
const api = new Api(base);
const root = byId("masklab");

try {
  const shipped = await api.choices("api/masks");
  render(<Lab api={api} base={base} shipped={shipped} />, root);
} catch (error) {
  render(<p role="alert">{messageOf(error)} Reload the page to try again.</p>, root);
}
