"""What a server and the page cost, and both against three.js."""
