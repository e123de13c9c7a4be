/** Opens the page. */
import "./style.css";
import { Api, ApiError } from "./api";
import { App } from "./app/app";
import { CapabilityError } from "./gl/capabilities";
import { byId } from "./ui/dom";
import { Curtain } from "./ui/curtain";

const curtain = new Curtain(byId("curtain"));

try {
  await App.open(new Api(), curtain);
} catch (error) {
  if (error instanceof CapabilityError) {
    curtain.fail("This sea needs a little more", `${error.message} A recent Chrome, Edge, Firefox or Safari on most computers and phones can draw it.`, null);
  } else if (error instanceof ApiError) {
    curtain.fail("The server is away", `${error.message} Once it is back, the sea is too.`, "Try again");
  } else {
    curtain.fail("Something went wrong", error instanceof Error ? error.message : String(error), "Try again");
    throw error;
  }
}
